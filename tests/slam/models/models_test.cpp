// The moments that FastSLAM 2.0 and UFastSLAM are made of, against Monte Carlo and against each other.
#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/gaussian.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr int kModelDraws = 40000;

template <class Model>
class Models : public ::testing::Test {
 protected:
  Model model_;
  long repairs_ = 0;
  RandomStream random_{5, Stream::kWorld};

  Pose draw(const PoseBelief& belief) {
    const Eigen::Matrix3d root = semidefinite_root<3>(belief.covariance, repairs_);
    return boxplus(belief.mean, root * Eigen::Vector3d(random_.normal(), random_.normal(), random_.normal()));
  }
  Eigen::Vector2d draw(const Eigen::Vector2d& mean, const Eigen::Matrix2d& covariance) {
    return mean +
           semidefinite_root<2>(covariance, repairs_) * Eigen::Vector2d(random_.normal(), random_.normal());
  }
};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(Models, BothModels);

PoseBelief some_pose() {
  PoseBelief belief{{1.0, -2.0, 3.1}, {}};  // near the seam of the angles
  belief.covariance << 4e-3, 1e-3, 5e-4, 1e-3, 3e-3, -4e-4, 5e-4, -4e-4, 9e-4;
  return belief;
}

LandmarkBelief some_landmark() {
  LandmarkBelief landmark{{-5.0, -2.5}, {}};
  landmark.covariance << 2e-2, -5e-3, -5e-3, 1e-2;
  return landmark;
}

Eigen::Matrix2d some_noise() {
  return Eigen::Vector2d(0.01, 0.0016).asDiagonal();
}

// The error of a covariance estimate, relative to its deviations; five standard errors, and second-order
// terms.
template <int kSize>
void expect_same_moments(const Eigen::Matrix<double, kSize, kSize>& a,
                         const Eigen::Matrix<double, kSize, kSize>& b) {
  const Eigen::Matrix<double, kSize, 1> sd = b.diagonal().cwiseSqrt().cwiseMax(1e-12);
  const Eigen::Matrix<double, kSize, kSize> off =
      sd.cwiseInverse().asDiagonal() * (a - b) * sd.cwiseInverse().asDiagonal();
  EXPECT_LE(off.cwiseAbs().maxCoeff(), 5.0 * std::sqrt(2.0 / kModelDraws) + 0.02) << a << "\nagainst\n" << b;
}

// Errata: eq. 6 and 7 (control noise belongs to the motion). Catches a dropped or swapped control noise, a
// wrong Jacobian by v, w or heading, and angles averaged across the seam.
TYPED_TEST(Models, MoveHasTheMomentsOfManyNoisyMoves) {
  const PoseBelief start = some_pose();
  const Eigen::Vector2d sd(0.2, 0.1);
  const OdometryNoise noise{sd.x(), 0.0, 0.0, sd.y(), 0.0, 0.0};
  for (const double w_radps : {0.8, 0.05}) {  // to beyond the seam, and onto it
    const Control control{1.5, w_radps, 0.6};
    const PoseBelief moved = this->model_.move(start, control, sd, this->repairs_);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kModelDraws; ++i) {
      const Pose drawn = advance(this->draw(start), perturb(control, noise, this->random_));
      const Eigen::Vector3d off = boxminus(drawn, moved.mean);
      mean += off / kModelDraws;
      second += off * off.transpose() / kModelDraws;
    }
    EXPECT_TRUE(near(mean, Eigen::Vector3d::Zero(), 0.005));
    expect_same_moments<3>(second - mean * mean.transpose(), moved.covariance);
  }
}

// Two noises and three states: one control leaves a singular covariance. Nothing may need its inverse.
TYPED_TEST(Models, OneControlLeavesRankTwo) {
  const PoseBelief moved = this->model_.move({}, {1.0, 0.5, 0.5}, {0.1, 0.1}, this->repairs_);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moved.covariance);
  EXPECT_LE(solver.eigenvalues()(0), 1e-4 * solver.eigenvalues()(1));
  EXPECT_GT(solver.eigenvalues()(1), 1e-6);
  EXPECT_EQ(this->repairs_, 0);
}

// Errata: eq. 17 and 19 leave out R and the landmark's covariance; public code stacks landmarks on one set of
// sigma columns. Catches S without R, S without Sigma, a wrong cross covariance and pose correlated with
// landmark.
TYPED_TEST(Models, ExpectHasTheMomentsOfManySightings) {
  const PoseBelief pose = some_pose();
  const LandmarkBelief landmark = some_landmark();
  const PredictedMeasurement expected =
      this->model_.expect(pose, landmark, {{}, some_noise()}, this->repairs_);
  Eigen::Matrix<double, 5, 1> mean = Eigen::Matrix<double, 5, 1>::Zero();
  Eigen::Matrix<double, 5, 5> second = Eigen::Matrix<double, 5, 5>::Zero();
  for (int i = 0; i < kModelDraws; ++i) {
    const Pose from = this->draw(pose);
    const Eigen::Vector2d seen = predict_sighting(from, this->draw(landmark.mean, landmark.covariance)) +
                                 this->draw(Eigen::Vector2d::Zero(), some_noise());
    Eigen::Matrix<double, 5, 1> off;
    off << boxminus(from, pose.mean), sighting_residual(seen, expected.expected);
    mean += off / kModelDraws;
    second += off * off.transpose() / kModelDraws;
  }
  Eigen::Matrix<double, 5, 5> joint;
  joint << pose.covariance, expected.cross, expected.cross.transpose(), expected.covariance;
  EXPECT_TRUE(near(mean, (Eigen::Matrix<double, 5, 1>::Zero()), 0.01));
  expect_same_moments<5>(second - mean * mean.transpose(), joint);
}

// The mean is held to five standard errors and what first order leaves out. Catches a transposed Jacobian,
// and sigma points whose mean has the wrong sign.
TYPED_TEST(Models, FoundHasTheMomentsOfManyFinds) {
  const Pose robot{1.0, 2.0, -3.0};
  const Observation seen{{6.0, 0.4}, some_noise()};
  const LandmarkBelief found = this->model_.found(robot, seen, this->repairs_);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kModelDraws; ++i) {
    const Eigen::Vector2d off = locate(robot, this->draw(seen.range_bearing, seen.noise)) - found.mean;
    mean += off / kModelDraws;
    second += off * off.transpose() / kModelDraws;
  }
  EXPECT_TRUE(near(mean, Eigen::Vector2d::Zero(), 0.007));
  expect_same_moments<2>(second - mean * mean.transpose(), found.covariance);
}

// With little noise a refined landmark is the information-weighted mean of before and now, an independent
// formula. Errata: eq. 26-31 (no R in S-bar, wrong columns) and eq. 33 (x for mu).
TYPED_TEST(Models, RefineAddsInformation) {
  const Pose robot{0.5, -1.0, 2.0};
  const LandmarkBelief before{{4.0, 3.0}, 1e-6 * (Eigen::Matrix2d() << 3.0, 1.0, 1.0, 2.0).finished()};
  const Eigen::Vector2d exact = predict_sighting(robot, before.mean);
  const Observation seen{exact + Eigen::Vector2d(1e-3, -2e-4), Eigen::Vector2d(4e-6, 1e-7).asDiagonal()};
  const LandmarkBelief now = this->model_.found(robot, seen, this->repairs_);
  const LandmarkBelief refined = this->model_.refine(before, robot, seen, this->repairs_);
  const Eigen::Matrix2d both = (before.covariance.inverse() + now.covariance.inverse()).inverse();
  const Eigen::Vector2d mean =
      both * (before.covariance.inverse() * before.mean + now.covariance.inverse() * now.mean);
  EXPECT_TRUE(near(refined.covariance, both, 2e-3 * both.norm()));
  EXPECT_TRUE(near(refined.mean, mean, 1e-5));
}

// A public implementation yields NaN here.
TYPED_TEST(Models, StandingOnALandmarkIsFinite) {
  const PoseBelief pose{{1.0, 1.0, 0.3}, some_pose().covariance};
  for (const PoseBelief& belief : {pose, PoseBelief{pose.mean, Eigen::Matrix3d::Zero()}}) {
    const LandmarkBelief landmark{{1.0, 1.0}, Eigen::Matrix2d::Zero()};
    const PredictedMeasurement expected =
        this->model_.expect(belief, landmark, {{}, some_noise()}, this->repairs_);
    EXPECT_TRUE(expected.covariance.allFinite() && expected.cross.allFinite() &&
                expected.expected.allFinite());
    const LandmarkBelief refined =
        this->model_.refine(landmark, belief.mean, {{0.0, 0.0}, some_noise()}, this->repairs_);
    EXPECT_TRUE(refined.mean.allFinite() && refined.covariance.allFinite());
    const LandmarkBelief found = this->model_.found(belief.mean, {{0.0, 0.0}, some_noise()}, this->repairs_);
    EXPECT_TRUE(found.mean.allFinite() && found.covariance.allFinite());
  }
}

// Where noise is small the two models are one. Catches an error in either, wherever the other does not have
// it.
TEST(BothModels, AgreeWhenNoiseIsSmall) {
  RandomStream random(6, Stream::kWorld);
  long repairs = 0;
  for (int i = 0; i < 100; ++i) {
    PoseBelief pose = some_pose();
    pose.mean.heading_rad = wrap_angle(3.0 * random.normal());
    pose.covariance *= 1e-6;
    const Control control{random.normal(), i == 0 ? 0.0 : random.normal(), 0.5};
    const PoseBelief a = Linearised().move(pose, control, {1e-4, 1e-4}, repairs);
    const PoseBelief b = Unscented().move(pose, control, {1e-4, 1e-4}, repairs);
    EXPECT_TRUE(near(a.mean, b.mean, 1e-7));
    EXPECT_TRUE(near(a.covariance, b.covariance, 1e-4 * a.covariance.norm()));
    LandmarkBelief landmark = some_landmark();
    landmark.covariance *= 1e-6;
    const PredictedMeasurement c = Linearised().expect(pose, landmark, {{}, 1e-6 * some_noise()}, repairs);
    const PredictedMeasurement d = Unscented().expect(pose, landmark, {{}, 1e-6 * some_noise()}, repairs);
    EXPECT_TRUE(near(c.covariance, d.covariance, 1e-4 * c.covariance.norm()));
    EXPECT_TRUE(near(c.cross, d.cross, 1e-4 * c.cross.norm()));
  }
}

// The motion since the last update, predicted once and put behind a pose, is the motion predicted at that
// pose.
TYPED_TEST(Models, SharedMotionIsEachParticlesMotion) {
  const Pose start{3.0, -1.0, 2.5};
  PoseBelief shared;
  PoseBelief own{start, Eigen::Matrix3d::Zero()};
  for (const Control& control : {Control{1.0, 0.3, 0.5}, Control{0.8, -0.6, 0.5}, Control{1.2, 0.0, 0.5}}) {
    shared = this->model_.move(shared, control, {0.1, 0.05}, this->repairs_);
    own = this->model_.move(own, control, {0.1, 0.05}, this->repairs_);
  }
  const PoseBelief placed = follow(start, shared);
  EXPECT_TRUE(near(placed.mean, own.mean, 1e-5));
  EXPECT_TRUE(near(placed.covariance, own.covariance, 1e-3 * own.covariance.norm()));
}

}  // namespace
}  // namespace stereobench::slam
