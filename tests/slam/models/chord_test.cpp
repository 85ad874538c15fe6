// A motion along and across its chord: there and back, its slopes, and what a control's noise is in it.
#include "slam/models/chord.h"

#include <array>

#include <gtest/gtest.h>

#include "slam/models/linearised.h"
#include "slam/models/motion.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

struct Motion {
  Pose from;
  Eigen::Vector3d chord;
};

Motion random_motion(RandomStream& random) {
  return {{random.normal(), random.normal(), wrap_angle(3.0 * random.normal())},
          {random.normal(), 0.3 * random.normal(), random.normal()}};
}

// Mutation: the direction at the start in place of half way of the turn.
TEST(Chord, LeadsWhereItWasTakenFrom) {
  RandomStream random(1, Stream::kWorld);
  for (int i = 0; i < 100; ++i) {
    const auto [from, chord] = random_motion(random);
    const Pose to = end_of(from, chord);
    EXPECT_LT((chord_between(from, to, chord.z()) - chord).norm(), 1e-12);
  }
}

// A control moves along its chord and turns, and never across it.
TEST(Chord, OfAControlIsItsArcs) {
  RandomStream random(2, Stream::kWorld);
  for (int i = 0; i < 100; ++i) {
    const Pose from = random_motion(random).from;
    const Control control{random.normal(), random.normal(), 0.2 + random.uniform()};
    const double turn_rad = control.w_radps * control.duration_s;
    const Eigen::Vector3d chord = chord_between(from, advance(from, control), turn_rad);
    EXPECT_NEAR(chord.y(), 0.0, 1e-12);
    EXPECT_NEAR(chord.x(), control.v_mps * control.duration_s * std::sin(0.5 * turn_rad) / (0.5 * turn_rad),
                1e-12);
  }
}

// Mutations: a sign, the half of a turn left out.
TEST(Chord, HasSlopesThatAreItsDerivatives) {
  RandomStream random(3, Stream::kWorld);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const auto [from, chord] = random_motion(random);
    const Eigen::Matrix3d slope = end_by_chord(from, chord);
    const Eigen::Matrix3d back =
        chord_by_end(from.heading_rad + 0.5 * chord.z(), chord_between(from, end_of(from, chord), chord.z()));
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(j);
      const Eigen::Vector3d moved = boxminus(end_of(from, chord + step), end_of(from, chord - step));
      EXPECT_LT((moved / (2.0 * kStep) - slope.col(j)).norm(), 1e-8);
    }
    EXPECT_TRUE((back * slope).isIdentity(1e-12)) << back * slope;
  }
}

// Mutation: the covariance in (x, y, heading), not turned.
TEST(Chord, HasNoNoiseAcrossASingleControl) {
  RandomStream random(4, Stream::kWorld);
  const Linearised model;
  long repairs = 0;
  for (int i = 0; i < 100; ++i) {
    const Control control{random.normal(), random.normal(), 0.2 + random.uniform()};
    const ChordBelief chord = chord_of(model.move({}, control, {0.2, 0.3}, repairs));
    EXPECT_LT(chord.covariance(1, 1), 1e-12);
    EXPECT_NEAR(chord.covariance(2, 2), std::pow(0.3 * control.duration_s, 2), 1e-12);
    EXPECT_GT(chord.covariance(0, 0), 0.0);
  }
}

// Velocities that a relative pose is made of lead where it does, with its covariance. Mutations seen to turn
// this red: the slope with the turn left out, there or back; the lateral speed to the right.
TEST(Chord, OfARelativePoseBecomesVelocitiesAndBack) {
  RandomStream random(5, Stream::kWorld);
  for (int i = 0; i < 100; ++i) {
    const Pose end = end_of({}, random_motion(random).chord);
    const Eigen::Matrix3d half = Eigen::Matrix3d::NullaryExpr([&] { return 0.1 * random.normal(); });
    const PoseBelief motion{end, half * half.transpose()};
    const Control control = control_of(motion, 0.2 + random.uniform());
    EXPECT_TRUE(near(advance({}, control), end, 1e-12));
    EXPECT_TRUE(near(motion_of(control).mean, end, 1e-12));
    EXPECT_TRUE(near(motion_of(control).covariance, motion.covariance, 1e-12));
    EXPECT_NEAR(control_of(motion, 2.0).v_mps * 2.0, control.v_mps * control.duration_s, 1e-12);
  }
}

// Its slopes are those of advance(). Mutation seen to turn this red: the slope with the turn left out.
TEST(Chord, OfVelocitiesHasTheSlopesOfAdvance) {
  constexpr double kStep = 1e-6;
  const Control control{0.7, -0.4, 1.5, 0.2};
  Eigen::Matrix3d slopes;
  for (int i = 0; i < 3; ++i) {
    Control above = control, below = control;
    const std::array<double Control::*, 3> parts = {&Control::v_mps, &Control::lateral_mps,
                                                    &Control::w_radps};
    above.*parts[static_cast<std::size_t>(i)] += kStep;
    below.*parts[static_cast<std::size_t>(i)] -= kStep;
    slopes.col(i) = boxminus(advance({}, above), advance({}, below)) / (2.0 * kStep);
  }
  Control stated = control;
  stated.covariance = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  EXPECT_TRUE(near(motion_of(stated).covariance, slopes * *stated.covariance * slopes.transpose(), 1e-8));
}

}  // namespace
}  // namespace stereobench::slam
