#include "slam/fastslam/frame_fit.h"

#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/fastslam/fast_slam.h"
#include "slam/fastslam/pose_correction.h"
#include "slam/filter_registry.h"
#include "slam/math/random.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

const Eigen::Matrix2d kPrecise = Eigen::Vector2d(1e-3 * 1e-3, 2e-4 * 2e-4).asDiagonal();

/// A frame of precise sightings of three landmarks from `truth`.
std::vector<Match> frame_from(const Pose& truth, const Eigen::Matrix2d& noise) {
  std::vector<Match> matches;
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(1.5, 0.4), Eigen::Vector2d(2.2, -0.7), Eigen::Vector2d(0.9, -0.3)})
    matches.push_back({{place, Eigen::Matrix2d::Identity() * 1e-8}, {predict_sighting(truth, place), noise}});
  return matches;
}

// Far from bends, one look at all sightings is what one look after the other is.
// Mutations: the determinant of the information left out, the prior's cost counted twice.
TEST(FrameFit, IsTheProductOfInnovationsWhereTheSensorIsLinear) {
  const PoseBelief predicted{{0.1, -0.2, 0.3}, Eigen::Vector3d(1e-8, 2e-8, 1e-8).asDiagonal()};
  long repairs = 0;
  RandomStream random(7, Stream::kFilter);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Match> matches = frame_from(predicted.mean, Eigen::Vector2d(1e-8, 1e-8).asDiagonal());
    Posterior one_by_one{predicted};
    for (Match& match : matches) {
      match.observation.range_bearing += 1e-4 * Eigen::Vector2d(random.normal(), random.normal());
      const PredictedMeasurement expected =
          Linearised().expect(one_by_one.pose, match.landmark, match.observation, repairs);
      const Eigen::Vector2d residual = sighting_residual(match.observation.range_bearing, expected.expected);
      const Eigen::Matrix2d inverse = expected.covariance.inverse();
      const Eigen::Matrix<double, 3, 2> gain = expected.cross * inverse;
      one_by_one.pose.mean = boxplus(one_by_one.pose.mean, gain * residual);
      one_by_one.pose.covariance -= gain * expected.cross.transpose();
      one_by_one.log_likelihood -= 0.5 * (residual.dot(inverse * residual) +
                                          std::log((2.0 * M_PI * expected.covariance).determinant()));
    }
    const FrameFit fit = fit_frame(predicted, matches, repairs);
    EXPECT_LE(boxminus(fit.posterior.pose.mean, one_by_one.pose.mean).norm(), 1e-6);
    EXPECT_LE((fit.posterior.pose.covariance - one_by_one.pose.covariance).norm(), 1e-11);
    EXPECT_NEAR(fit.posterior.log_likelihood, one_by_one.log_likelihood, 0.05);
  }
  EXPECT_EQ(repairs, 0);
}

// Mutations: a single iteration, or Jacobians kept from the prediction.
TEST(FrameFit, FindsAPoseThatBendsAway) {
  const Pose truth{0.12, 0.05, 0.25};
  const PoseBelief predicted{{0.0, 0.0, 0.0}, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()};
  long repairs = 0;
  const FrameFit fit = fit_frame(predicted, frame_from(truth, kPrecise), repairs);
  EXPECT_LE(boxminus(fit.posterior.pose.mean, truth).norm(), 5e-4);
  EXPECT_LE(fit.sighting_cost, 1.0);
  const FrameFit at_truth = fit_frame({truth, predicted.covariance}, frame_from(truth, kPrecise), repairs);
  const Eigen::Matrix3d covariance = at_truth.posterior.pose.covariance;
  EXPECT_LE((fit.posterior.pose.covariance - covariance).norm(), 0.02 * covariance.norm());
  EXPECT_NEAR(fit.prior_cost, (0.12 * 0.12 + 0.05 * 0.05 + 0.25 * 0.25) / 0.01, 0.5);
}

TEST(FrameFit, APoseThatIsKnownStaysWhereItIs) {
  long repairs = 0;
  const PoseBelief known{{1.0, 2.0, 3.0}, Eigen::Matrix3d::Zero()};
  const FrameFit fit = fit_frame(known, frame_from({1.1, 2.0, 3.0}, kPrecise), repairs);
  EXPECT_EQ(boxminus(fit.posterior.pose.mean, known.mean).norm(), 0.0);
  EXPECT_EQ(fit.posterior.pose.covariance.norm(), 0.0);
  EXPECT_GT(fit.sighting_cost, 100.0);
}

/// A filter that knows three landmarks well, told that it drove straight while it turned by `turned_rad`.
template <class Model>
Estimate after_a_slip(double turned_rad) {
  FilterConfig config;
  config.particles = 20;
  config.odometry_noise = {.v_constant_mps = 0.02, .w_constant_radps = 0.02};
  FastSlam<Model> filter(config, {}, 3);
  for (const double heading : {0.0, 0.0, 0.0, turned_rad}) {
    const Pose truth{0.0, 0.0, heading};
    std::vector<RangeBearing> sightings;
    for (const Match& match : frame_from(truth, kPrecise)) {
      const Eigen::Vector2d seen = match.observation.range_bearing;
      sightings.push_back({seen.x(), seen.y(), kPrecise, static_cast<int>(sightings.size())});
    }
    filter.predict({.v_mps = 0.0, .w_radps = 0.0, .duration_s = 1.0});
    filter.update(sightings);
  }
  return filter.estimate();
}

// The heading is 5 standard deviations off what the odometry says, and three landmarks agree on it.
// Mutation: refusing the frame, as a gate on each sighting alone does, leaves the heading at 0.
TEST(SecondLook, LandmarksThatAgreeOverruleTheOdometry) {
  EXPECT_NEAR(after_a_slip<Linearised>(0.1).pose.heading_rad, 0.1, 2e-3);
  EXPECT_NEAR(after_a_slip<Unscented>(0.1).pose.heading_rad, 0.1, 2e-3);
}

}  // namespace
}  // namespace stereobench::slam
