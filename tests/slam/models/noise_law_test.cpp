// Noise that depends on the range: evaluated where a landmark should be seen.
#include "slam/models/noise_law.h"

#include <cmath>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/fastslam/frame_fit.h"
#include "slam/fastslam/pose_correction.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "slam/reference/batch.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// A pair of 887 px and 0.12 m whose disparity is off by 0.42 px: 0.9 m at 15 m.
constexpr double kGrowth = 0.42 / (887.0 * 0.12);

Observation grown(double range_m, double bearing_rad = 0.0) {
  return {{range_m, bearing_rad}, Eigen::Vector2d(1e-4, 1e-4).asDiagonal().toDenseMatrix(), kGrowth};
}

TEST(NoiseLaw, ReplacesWhatASightingStatesAndKeepsTheFloor) {
  RangeBearing seen = sighting({10.0, 0.3}, 0.5, 0.02);
  FilterConfig config{.range_floor_m = 0.01, .bearing_floor_rad = 0.001};
  EXPECT_NEAR(noise_at(observe(seen, config), {20.0, 0.0})(0, 0), 0.25 + 1e-4, 1e-15);
  EXPECT_NEAR(noise_at(observe(seen, config), {20.0, 0.0})(1, 1), 4e-4 + 1e-6, 1e-15);
  config.noise_law = {.range_sd_m = 0.2, .range_sd_per_m2 = 0.003, .bearing_sd_rad = 0.05};
  seen.covariance(0, 1) = seen.covariance(1, 0) = 0.005;
  const Eigen::Matrix2d noise = noise_at(observe(seen, config), {20.0, 0.0});
  EXPECT_NEAR(noise(0, 0), 0.04 + 1.2 * 1.2 + 1e-4, 1e-12);
  EXPECT_NEAR(noise(1, 1), 2.5e-3 + 1e-6, 1e-15);
  EXPECT_EQ(noise(0, 1), 0.0);
}

// Mutation: a floor that was lower already is raised.
TEST(NoiseLaw, HardlyAnyFloorIsLeftWithoutIt) {
  EXPECT_EQ(without_floor({}).range_floor_m, 1e-5);
  EXPECT_EQ(without_floor({}).bearing_floor_rad, 1e-7);
  EXPECT_EQ(without_floor({.range_floor_m = 1e-6, .bearing_floor_rad = 0.0}).range_floor_m, 1e-6);
  EXPECT_EQ(without_floor({.range_floor_m = 1e-6, .bearing_floor_rad = 0.0}).bearing_floor_rad, 0.0);
}

// Deviations are scaled, so that a covariance of both goes with their product, and the floor stays as it is.
// Mutation: variances to scale.
TEST(NoiseLaw, StatedNoiseIsBelievedToScale) {
  RangeBearing seen = sighting({10.0, 0.3}, 0.5, 0.02);
  seen.covariance(0, 1) = seen.covariance(1, 0) = 0.005;
  const FilterConfig config{.stated_sd_scale = {3.0, 0.5}, .range_floor_m = 0.01, .bearing_floor_rad = 0.001};
  const Eigen::Matrix2d noise = noise_at(observe(seen, config), {20.0, 0.0});
  EXPECT_NEAR(noise(0, 0), 9.0 * 0.25 + 1e-4, 1e-12);
  EXPECT_NEAR(noise(1, 1), 0.25 * 4e-4 + 1e-6, 1e-15);
  EXPECT_NEAR(noise(0, 1), 1.5 * 0.005, 1e-15);
}

// A law that is constant and sightings that state the same are the same to the last bit.
// Mutation: a law that is not asked.
TEST(NoiseLaw, ConstantIsWhatSightingsThatStateItAre) {
  Drive world;
  FilterConfig config{.particles = 10, .odometry_noise = world.odometry_noise};
  for (const std::string& name : filter_names()) {
    const Estimate stated = drive(make_filter(name, config, {}, 1), world, 2).last;
    FilterConfig lawful = config;
    lawful.noise_law = {.range_sd_m = world.range_sd_m, .bearing_sd_rad = world.bearing_sd_rad};
    RandomStream odometry(2, Stream::kOdometry), sensor(2, Stream::kOracle);
    Filter filter = make_filter(name, lawful, {}, 1);
    Pose truth;
    for (const Control& control : world.controls()) {
      truth = advance(truth, control);
      predict(filter, perturb(control, world.odometry_noise, odometry));
      std::vector<RangeBearing> frame = world.look(truth, sensor);
      for (RangeBearing& seen : frame) seen.covariance *= 100.0;
      update(filter, frame);
    }
    EXPECT_TRUE(near(estimate(filter).pose, stated.pose, 0.0)) << name;
    EXPECT_TRUE(near(estimate(filter).covariance, stated.covariance, 0.0)) << name;
  }
}

template <class Model>
class LawfulModels : public ::testing::Test {
 protected:
  Model model_;
  long repairs_ = 0;
};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(LawfulModels, BothModels);

// From a known pose a landmark at 15 m: what it should look like does not depend on what was seen, so that a
// reading that is a metre short weighs as much as one that is a metre long, and moves the landmark as much.
// Mutation: noise at the range that was seen, in expect or in refine.
TYPED_TEST(LawfulModels, ShortAndLongReadingsWeighTheSame) {
  const LandmarkBelief landmark{{15.0, 0.0}, Eigen::Vector2d(0.3, 1e-12).asDiagonal().toDenseMatrix()};
  const PoseBelief pose{};
  const auto expect = [&](double range_m) {
    return this->model_.expect(pose, landmark, grown(range_m), this->repairs_);
  };
  EXPECT_EQ(expect(14.0).covariance, expect(16.0).covariance);
  EXPECT_NEAR(expect(14.0).covariance(0, 0), 0.3 + 1e-4 + std::pow(kGrowth * 225.0, 2), 1e-6);
  const LandmarkBelief shorter = this->model_.refine(landmark, pose.mean, grown(14.0), this->repairs_);
  const LandmarkBelief longer = this->model_.refine(landmark, pose.mean, grown(16.0), this->repairs_);
  EXPECT_TRUE(near(shorter.covariance, longer.covariance, 1e-12));
  EXPECT_NEAR(longer.mean.x() - 15.0, 15.0 - shorter.mean.x(), 1e-9);
}

// Nothing is expected of what is new: the range that was seen is all there is.
TYPED_TEST(LawfulModels, WhatIsNewIsAsUncertainAsItsOwnRangeSays) {
  const LandmarkBelief found = this->model_.found({}, grown(15.0), this->repairs_);
  EXPECT_NEAR(found.covariance(0, 0), 1e-4 + std::pow(kGrowth * 225.0, 2), 1e-3);
}

// Mutation: noise at the range that was seen when a frame is fitted as a whole.
TEST(NoiseLaw, AFrameIsFittedWithTheNoiseOfWhereItShouldBeSeen) {
  const PoseBelief predicted{{}, Eigen::Vector3d(1e-10, 1e-10, 1e-10).asDiagonal().toDenseMatrix()};
  const LandmarkBelief landmark{{15.0, 0.0}, Eigen::Matrix2d::Zero()};
  long repairs = 0;
  const Match near_m{landmark, grown(14.0)}, far_m{landmark, grown(16.0)};
  const auto fit = [&](const Match& match) {
    return fit_frame(Linearised(), {}, chord_of(predicted), std::span(&match, 1), repairs);
  };
  EXPECT_NEAR(fit(near_m).log_likelihood, fit(far_m).log_likelihood, 1e-6);
}

// A landmark of a metre's uncertainty in range, looked at from where the robot stands, again and again. Each
// look's error is independent. What they are fused to is the mean of the looks, off by no more than five
// standard errors of it over all seeds, and what little the first looks leave: to second order the mean is
// long by 4 sd^2 / r (log n) / n, as a state that is too long makes less of what says so. With the noise of
// the range that was seen each look's weight goes with its own error, and the result is short by 4 sd^2 / r.
double fused_offset_m(const std::string& name, const FilterConfig& config, bool states_its_own) {
  constexpr int kSeeds = 200, kLooks = 200;
  constexpr double kRange_m = 15.0;
  const double sd_m = kGrowth * kRange_m * kRange_m;
  double off_m = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RandomStream sensor(seed, Stream::kOracle);
    Filter filter = make_filter(name, config, {}, seed);
    for (int look = 0; look < kLooks; ++look) {
      const double range_m = kRange_m + sd_m * sensor.normal();
      RangeBearing seen = sighting({range_m, 0.0}, states_its_own ? kGrowth * range_m * range_m : 99.0, 1e-3);
      seen.landmark_id = 1;
      update(filter, std::vector<RangeBearing>{seen});
    }
    off_m += (estimate(filter).landmarks.at(0).position_m.x() - kRange_m) / kSeeds;
  }
  return off_m;
}

// Mutations: noise_at the range that was seen, in refine of either model or in the EKF's innovation.
TEST(NoiseLaw, WhatIsFusedAtThePredictedRangeIsNotShort) {
  const double sd_m = kGrowth * 225.0;
  const double standard_error_m = sd_m / std::sqrt(200.0 * 200.0);
  const double second_order_m = 4.0 * sd_m * sd_m / 15.0;
  for (const std::string name : {"ekf", "iekf", "smoother", "fastslam1", "fastslam2", "ufastslam",
                                 "ufastslam_kim", "fastslam2_block", "ufastslam_block"}) {
    FilterConfig config{.particles = 1, .gate_probability = 1.0};
    EXPECT_NEAR(fused_offset_m(name, config, true), -second_order_m, 0.15 * second_order_m) << name;
    config.noise_law = {.range_sd_per_m2 = kGrowth, .bearing_sd_rad = 1e-3};
    EXPECT_NEAR(fused_offset_m(name, config, false), second_order_m * std::log(200.0) / 200.0,
                5.0 * standard_error_m)
        << name;
  }
}

// Mutation: the smoother's graph told the noise without its growth.
TEST(NoiseLaw, IsClaimedOfWhatWasSeenOnce) {
  FilterConfig config{.particles = 1};
  config.noise_law = {.range_sd_per_m2 = kGrowth, .bearing_sd_rad = 1e-3};
  for (const std::string name :
       {"ekf", "iekf", "smoother", "fastslam2", "ufastslam", "fastslam2_block", "ufastslam_block"}) {
    Filter filter = make_filter(name, config, {}, 1);
    RangeBearing seen = sighting({15.0, 0.0}, 99.0, 1e-3);
    seen.landmark_id = 1;
    update(filter, std::vector<RangeBearing>{seen});
    const double claimed_sd_m = std::sqrt(estimate(filter).landmarks.at(0).covariance(0, 0));
    EXPECT_NEAR(claimed_sd_m, kGrowth * 225.0, 0.02 * kGrowth * 225.0) << name;
  }
}

// The whole log at once knows better still: all looks weigh the same, and the batch is their mean.
// Mutation: noise_at the range that was seen, in the batch.
TEST(NoiseLaw, TheBatchIsTheMeanOfTheLooks) {
  FilterConfig config{.gate_probability = 1.0};
  config.noise_law = {.range_sd_per_m2 = kGrowth, .bearing_sd_rad = 1e-3};
  RandomStream sensor(1, Stream::kOracle);
  std::vector<BatchStep> steps;
  double mean_m = 0.0;
  for (int look = 0; look < 50; ++look) {
    const double range_m = 15.0 + kGrowth * 225.0 * sensor.normal();
    RangeBearing seen = sighting({range_m, 0.0}, 99.0, 1e-3);
    seen.landmark_id = 1;
    steps.push_back({{}, {seen}});
    mean_m += range_m / 50;
  }
  EXPECT_NEAR(estimate_batch(config, {}, steps).landmarks.at(0).position_m.x(), mean_m, 1e-3);
}

// The search of a large map through its bounds, where noise grows with the range: what is far off may have
// been seen much nearer. Mutation: bounds that do not grow.
TYPED_TEST(LawfulModels, TheSearchMissesNothingFarAway) {
  RandomStream random(6, Stream::kWorld);
  Particle particle;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d place(5.0 + 60.0 * random.uniform(), 4.0 * random.uniform());
    particle.classed.push_back({{place, 1e-4 * Eigen::Matrix2d::Identity()}, i, 5, 0});
  }
  const PoseBelief predicted{};
  FilterCounters counters;
  int far_off = 0;
  for (int i = 0; i < 300; ++i) {
    const LandmarkBelief& landmark = particle.classed[static_cast<std::size_t>(i)].belief;
    const Eigen::Vector2d expected = predict_sighting({}, landmark.mean);
    Sighting seen{grown(expected.x() - 3.5 * kGrowth * expected.x() * expected.x(), expected.y()), kUnknown,
                  i};
    if (seen.observation.range_bearing.x() < 0.0) continue;
    Target target;
    PoseCorrection<TypeParam>({}).correct(particle, predicted, chord_of(predicted), std::span(&seen, 1),
                                          std::span(&target, 1), counters);
    EXPECT_EQ(target.landmark, i);
    far_off += seen.observation.range_bearing.x() < 0.5 * expected.x() ? 1 : 0;
  }
  EXPECT_GT(far_off, 50);
}

}  // namespace
}  // namespace stereobench::slam
