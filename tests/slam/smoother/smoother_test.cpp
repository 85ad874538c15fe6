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
// deviation. Mutations: a drifted start; kCurved = 10.
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

/// How a filter fares on drives around a square.
struct Score {
  double rms_m = 0.0;
  double nees = 0.0;  ///< a third, over all steps: 1 is honest
};
Score drive_of(const std::string& name, int seeds, const Drive& world) {
  Score score;
  int steps = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    RandomStream odometry(static_cast<std::uint64_t>(seed), Stream::kOdometry);
    RandomStream sensor(static_cast<std::uint64_t>(seed), Stream::kOracle);
    Filter filter = make_filter(name, {.odometry_noise = world.odometry_noise}, {}, 1);
    Pose truth;
    update(filter, world.look(truth, sensor));
    for (const Control& control : world.controls()) {
      truth = advance(truth, control);
      predict(filter, perturb(control, world.odometry_noise, odometry));
      update(filter, world.look(truth, sensor));
      const Estimate now = estimate_without_map(filter);
      const Eigen::Vector3d error = boxminus(now.pose, truth);
      score.rms_m += error.head<2>().squaredNorm();
      score.nees += error.dot(now.covariance.ldlt().solve(error)) / 3.0;
      ++steps;
    }
  }
  score.rms_m = std::sqrt(score.rms_m / steps);
  score.nees /= steps;
  return score;
}

// Mutation: the reader's belief kept from frame to frame, which is the iterated EKF.
TEST(Smoother, IsAsGoodAsItClaims) {
  const Score smoother = drive_of("smoother", 30, {});
  const Score ekf = drive_of("ekf", 30, {});
  EXPECT_LT(smoother.rms_m, 1.05 * ekf.rms_m);
  EXPECT_GT(smoother.nees, 0.7);
  EXPECT_LT(smoother.nees, 1.4);
}

// Where bearings are off by 14 degrees, landmarks move by metres after they were first seen, and what was
// seen of them from the start, where the pose is certain, bends. Mutations: factors of landmarks never looked
// at again; steps halved along slopes of long ago.
TEST(Smoother, IsHonestWhereBearingsArePoor) {
  Drive poor;
  poor.side_m = 12.0;
  poor.laps = 2;
  poor.range_sd_m = 0.3;
  poor.max_range_m = 25.0;
  poor.bearing_sd_rad = 0.25;
  poor.odometry_noise = {0.3, 0.0, 0.0, 0.05, 0.0, 0.0};
  const Score smoother = drive_of("smoother", 10, poor);
  const Score ekf = drive_of("ekf", 10, poor);
  EXPECT_LT(smoother.rms_m, 0.6 * ekf.rms_m);
  EXPECT_LT(smoother.nees, 2.0);
}

}  // namespace
}  // namespace stereobench::slam
