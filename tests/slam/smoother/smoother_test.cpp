#include "slam/smoother/smoother.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/filter_registry.h"
#include "tests/slam/checks.h"
#include "tests/slam/course.h"

namespace stereobench::slam {
namespace {

/// Nothing but the noise that there is: no floors, no gate.
FilterConfig bare(const OdometryNoise& noise) {
  return {.odometry_noise = noise, .range_floor_m = 0.0, .bearing_floor_rad = 0.0, .gate_probability = 1.0};
}

class SmootherLaw : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, SmootherLaw, testing::Range<std::uint64_t>(0, 6));

// At each step the pose and its covariance are those of the optimum over all controls' errors and landmarks
// up to then, worked out densely and with numeric derivatives. Two motions that no sighting parts are one to
// first order, and slopes are as good as right: both together move it by less than a seventh of its
// deviation. Mutations: kCurved = 10; a motion's covariance ten times as large; sightings taken for linear a
// hundred times too far, motions always; steps judged by what slopes foresee alone.
TEST_P(SmootherLaw, IsTheOptimumOfAllUpToNow) {
  for (const int controls : {1, 3}) {
    const Course measured = Course(GetParam(), controls).measured(GetParam());
    Smoother smoother(bare(measured.noise), measured.start);
    const std::vector<BatchStep> log = batch_log(measured);
    for (std::size_t k = 0; k < log.size(); ++k) {
      for (const Control& control : log[k].controls) smoother.predict(control);
      smoother.update(log[k].sightings);
      if (log[k].sightings.empty()) continue;
      const std::vector<DenseStep> prefix(measured.steps.begin(),
                                          measured.steps.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      const DenseDrive dense(measured.noise, measured.start, prefix, 5);
      Eigen::VectorXd best = dense.unknowns_at(kCoursePlaces);
      best = dense.solve(best);
      const Eigen::Matrix3d expected = dense.pose_covariance(best, dense.covariance(best, k + 1), k + 1);
      const Eigen::Vector3d end = dense.path(best)[k];
      const Estimate estimate = smoother.estimate_without_map();
      const Eigen::Vector3d off = boxminus(estimate.pose, {end.x(), end.y(), wrap_angle(end.z())});
      const Eigen::Vector3d sd = expected.diagonal().cwiseSqrt();
      for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(off[i]), 0.15 * sd[i]) << "step " << k;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(estimate.covariance(i, i)), sd[i], 0.08 * sd[i]);
    }
  }
}

/// How a filter fares on some drives.
struct Score {
  double rms_m = 0.0;  ///< mean of the drives'
  double nees = 0.0;   ///< a third, over all steps: 1 is consistent
};
Score score_of(const std::string& name, int seeds, const Drive& world) {
  Score score;
  const double steps = seeds * static_cast<double>(world.controls().size());
  for (int seed = 0; seed < seeds; ++seed) {
    const Filter filter = make_filter(name, {.odometry_noise = world.odometry_noise}, {}, 1);
    const auto add_nees = [&](const Estimate& now, const Pose& truth) {
      const Eigen::Vector3d error = boxminus(now.pose, truth);
      score.nees += error.dot(now.covariance.ldlt().solve(error)) / 3.0 / steps;
    };
    score.rms_m += drive(filter, world, static_cast<std::uint64_t>(seed), add_nees).rms_m / seeds;
  }
  return score;
}

// Mutations: a motion's covariance ten times as large; the reader's belief kept from frame to frame.
TEST(Smoother, IsAsGoodAsItClaims) {
  const Score smoother = score_of("smoother", 30, {});
  EXPECT_GT(smoother.nees, 0.7);
  EXPECT_LT(smoother.nees, 1.4);
}

// Landmarks move by metres after they were first seen, and what was seen of them from the start, where the
// pose is certain, bends. Mutations: factors of landmarks never looked at again; the reader's belief kept
// from frame to frame, which is the iterated EKF; factors looked at only where the variable that is
// eliminated first has moved, and not the other. Steps halved along slopes of long ago stay green.
TEST(Smoother, IsConsistentWhereBearingsArePoor) {
  Drive poor = drive_with_poor_bearings();
  poor.looks_at_start = true;
  const Score smoother = score_of("smoother", 10, poor);
  const Score iterated = score_of("iekf", 10, poor);
  EXPECT_LT(smoother.rms_m, 0.75 * iterated.rms_m);
  EXPECT_LT(smoother.nees, 2.0);
}

}  // namespace
}  // namespace stereobench::slam
