#include "slam/models/residuals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/models/linearised.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr double kStep = 1e-6;

/// A motion of some controls and its covariance.
PoseBelief motion_of(const std::vector<Control>& controls, const Eigen::Vector2d& control_sd) {
  PoseBelief motion;
  long repairs = 0;
  for (const Control& control : controls) motion = Linearised().move(motion, control, control_sd, repairs);
  return motion;
}

Pose random_pose(RandomStream& random) {
  return {3.0 * random.normal(), 3.0 * random.normal(), 6.0 * random.uniform() - 3.0};
}

Pose nudged(const Pose& pose, int dimension, double by) {
  return boxplus(pose, by * Eigen::Vector3d::Unit(dimension));
}

class ResidualLaw : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, ResidualLaw, testing::Range<std::uint64_t>(0, 20));

// Mutations seen to turn this red: the middle direction not turned by the pose at its end; a sign of either.
TEST_P(ResidualLaw, MotionHasTheDerivativesItClaims) {
  RandomStream random(GetParam(), Stream::kFilter);
  const Control control{random.normal(), 2.0 * random.normal(), 0.7};
  const MotionResidual residual(motion_of({control, control}, {0.3, 0.2}));
  const Pose from = random_pose(random);
  const Pose to = boxplus(advance(advance(from, control), control),
                          0.3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  const MotionResidual::Value value = residual.at(from, to);
  const double tolerance = 1e-6 * value.by_to.norm();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d by_from = (residual.at(nudged(from, i, kStep), to).residual -
                                     residual.at(nudged(from, i, -kStep), to).residual) /
                                    (2.0 * kStep);
    const Eigen::Vector3d by_to = (residual.at(from, nudged(to, i, kStep)).residual -
                                   residual.at(from, nudged(to, i, -kStep)).residual) /
                                  (2.0 * kStep);
    EXPECT_TRUE(near(value.by_from.col(i), by_from, tolerance));
    EXPECT_TRUE(near(value.by_to.col(i), by_to, tolerance));
  }
}

TEST_P(ResidualLaw, SightingHasTheDerivativesItClaims) {
  RandomStream random(GetParam(), Stream::kFilter);
  const Pose robot = random_pose(random);
  const Eigen::Vector2d place(3.0 * random.normal(), 3.0 * random.normal());
  Observation seen{{1.0, 0.5}, Eigen::Matrix2d::Identity()};
  seen.noise << 0.04, 0.003, 0.003, 0.01;
  const SightingResidual residual(seen);
  const SightingResidual::Value value = residual.at(robot, place);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d slope = (residual.at(nudged(robot, i, kStep), place).residual -
                                   residual.at(nudged(robot, i, -kStep), place).residual) /
                                  (2.0 * kStep);
    EXPECT_TRUE(near(value.by_pose.col(i), slope, 1e-5 * value.by_pose.norm()));
  }
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d nudge = kStep * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d slope =
        (residual.at(robot, place + nudge).residual - residual.at(robot, place - nudge).residual) /
        (2.0 * kStep);
    EXPECT_TRUE(near(value.by_landmark.col(i), slope, 1e-5 * value.by_landmark.norm()));
  }
}

// A single control's error e sd(v), f sd(w) is the residual (e, f), whatever its size: nothing moves across.
// Mutation: comparing in the frame of the step's start, where a bend moves across.
TEST_P(ResidualLaw, ASingleControlsErrorsAreItsResiduals) {
  RandomStream random(GetParam(), Stream::kFilter);
  const Control control{1.0 + 0.1 * random.normal(), random.normal(), 0.5};
  const Eigen::Vector2d sd(0.1, 0.3);
  const MotionResidual residual(motion_of({control}, sd));
  const Pose from = random_pose(random);
  for (const double errors : {0.1, 1.0, 3.0}) {
    Control done = control;
    done.w_radps += errors * sd.y();
    EXPECT_NEAR(residual.at(from, advance(from, done)).residual.norm(), errors, 0.02 * errors);
    done = control;
    done.v_mps -= errors * sd.x();
    EXPECT_NEAR(residual.at(from, advance(from, done)).residual.norm(), errors, 0.01 * errors);
  }
  EXPECT_LE(residual.at(from, advance(from, control)).residual.norm(), 1e-9);
}

// Squares of what really happens average to the rank of the noise plus next to nothing.
TEST(MotionResidual, HasUnitVarianceInEachDirectionOfItsNoise) {
  RandomStream random(1, Stream::kFilter);
  const std::vector<Control> controls = {{0.5, 0.2, 0.5}, {0.5, -0.4, 0.5}, {0.6, 0.3, 0.5}};
  const Eigen::Vector2d sd(0.05, 0.03);
  for (const std::size_t count : {1U, 3U}) {
    const std::vector<Control> some(controls.begin(), controls.begin() + static_cast<long>(count));
    const MotionResidual residual(motion_of(some, sd));
    constexpr int kDraws = 4000;
    double squares = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      Pose to{1.0, 2.0, 3.0};
      for (Control control : some) {
        control.v_mps += sd.x() * random.normal();
        control.w_radps += sd.y() * random.normal();
        to = advance(to, control);
      }
      squares += residual.at({1.0, 2.0, 3.0}, to).residual.squaredNorm() / kDraws;
    }
    const double rank = count == 1 ? 2.0 : 3.0;
    EXPECT_NEAR(squares, rank, 5.0 * std::sqrt(2.0 * rank / kDraws));
  }
}

TEST(SightingResidual, WrapsTheBearing) {
  const SightingResidual residual({{2.0, 3.1}, Eigen::Vector2d(0.01, 0.01).asDiagonal()});
  const Eigen::Vector2d place = locate({}, {2.0, -3.1});
  EXPECT_NEAR(residual.at({}, place).residual.y(), (2.0 * M_PI - 6.2) / 0.1, 1e-3);
}

}  // namespace
}  // namespace stereobench::slam
