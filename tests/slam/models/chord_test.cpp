// A motion along and across its chord: there and back, its slopes, and what a control's noise is in it.
#include "slam/models/chord.h"

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

}  // namespace
}  // namespace stereobench::slam
