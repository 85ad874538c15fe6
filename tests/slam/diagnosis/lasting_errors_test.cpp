// Errors that last are found, and sightings weighed by them.
#include "slam/diagnosis/lasting_errors.h"

#include <map>
#include <utility>

#include <Eigen/Cholesky>

#include "slam/models/noise_law.h"
#include "tests/slam/diagnosis/recorded_drive.h"

namespace stereobench::slam {
namespace {

constexpr double kTime_s = 2.0;
constexpr double kRangeSd_m = 0.1;

FilterConfig config_of(const Drive& world) {
  FilterConfig config;
  config.odometry_noise = world.odometry_noise;
  return config;
}

// A drive on which the ranges of a landmark have errors that last.
std::vector<BatchStep> lasting_drive(Drive world, std::uint64_t seed) {
  world.range_sd_m = 0.0;
  std::vector<BatchStep> steps = recorded(world, seed);
  RandomStream noise(seed, Stream::kFilter);
  std::map<int, std::pair<double, double>> last;  // by landmark: time, error
  double now_s = 0.0;
  for (BatchStep& step : steps) {
    now_s += step.controls[0].duration_s;
    for (RangeBearing& seen : step.sightings) {
      auto& [time_s, error_m] = last[seen.landmark_id];
      const double kept = error_m == 0.0 ? 0.0 : std::exp(-(now_s - time_s) / kTime_s);
      error_m = kept * error_m + std::sqrt(1.0 - kept * kept) * kRangeSd_m * noise.normal();
      time_s = now_s;
      seen.range_m = std::abs(seen.range_m + error_m);
      seen.covariance(0, 0) = kRangeSd_m * kRangeSd_m;
    }
  }
  return steps;
}

// The filter itself gives way to an error that lasts, so that the time comes out a little short.
// Mutations seen to turn this red: pairs of different landmarks; gaps counted in steps; ranges and bearings
// exchanged.
TEST(LastingErrors, AreFoundInRangesThatHaveThem) {
  const Drive world;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const LastingErrors found = find_lasting_errors(config_of(world), {}, lasting_drive(world, seed));
    EXPECT_GT(found.time_s[0], 0.6 * kTime_s);
    EXPECT_LT(found.time_s[0], 1.3 * kTime_s);
    EXPECT_NEAR(found.correlation[0], std::exp(-found.gap_s / found.time_s[0]), 1e-12);
    EXPECT_EQ(found.time_s[1], 0.0) << "bearings have errors of their own";
  }
}

// Mutation: kCorrelated 0.
TEST(LastingErrors, AreNotFoundWhereEachErrorIsItsOwn) {
  const Drive world;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_TRUE(find_lasting_errors(config_of(world), {}, recorded(world, seed)).time_s.isZero()) << seed;
  EXPECT_TRUE(find_lasting_errors(config_of(world), {}, {}).time_s.isZero());
}

// A filter that trusts a poor odometry lags behind: as it is told, its innovations are correlated by 0.6 and
// 0.7. Mutation seen to turn this red: innovations of the filter as it is told.
TEST(LastingErrors, AreNotThoseOfAnOdometryThatIsToldTooPrecise) {
  Drive world;
  world.range_sd_m = 0.05;
  world.odometry_noise = {0.2, 0.0, 0.0, 0.05, 0.0, 0.0};
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const std::vector<BatchStep> steps = recorded(world, seed);
    FilterConfig config = config_of(world);
    config.odometry_noise.v_constant_mps /= 20.0;
    config.odometry_noise.w_constant_radps /= 20.0;
    EXPECT_TRUE(find_lasting_errors(config, {}, steps).time_s.isZero()) << seed;
  }
}

// Mutations: the gap to any landmark's last sighting; variances for standard deviations; the first one
// weighed.
TEST(LastingErrors, WeighASightingByTheTimeSinceItsLandmarkWasSeen) {
  const auto seen = [](int landmark) {
    RangeBearing one = sighting({4.0, 0.1 * landmark}, 0.1, 0.01);
    one.landmark_id = landmark;
    return one;
  };
  const Control second{0.0, 0.0, 1.0};
  std::vector<BatchStep> steps = {
      {{second}, {seen(1)}}, {{second}, {seen(2)}}, {{second, second}, {seen(2), seen(1)}}};
  weigh_by_gaps({}, {}, {2.0, 0.0}, steps);
  EXPECT_EQ(steps[0].sightings[0].sd_scale, Eigen::Vector2d::Ones());
  EXPECT_EQ(steps[1].sightings[0].sd_scale, Eigen::Vector2d::Ones());
  EXPECT_NEAR(steps[2].sightings[0].sd_scale[0], 1.0 / std::sqrt(1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(steps[2].sightings[1].sd_scale[0], 1.0 / std::sqrt(1.0 - std::exp(-1.5)), 1e-12);
  EXPECT_EQ(steps[2].sightings[0].sd_scale[1], 1.0);
}

// Outliers weigh no more than others, and sightings of one instant alike. Mutation seen to turn this red: the
// second of an instant weighed by a gap of nothing.
TEST(LastingErrors, WeighEverySightingOfALandmark) {
  const Control second{0.0, 0.0, 1.0};
  const auto seen = [](double range_m) {
    RangeBearing one = sighting({range_m, 0.1}, 0.1, 0.01);
    one.landmark_id = 5;
    return one;
  };
  std::vector<BatchStep> steps(4, {{second}, {seen(4.0)}});
  steps[2].sightings[0] = seen(9.0);
  steps[3].sightings.push_back(seen(4.0));
  weigh_by_gaps({}, {}, {2.0, 2.0}, steps);
  const double weighed = 1.0 / std::sqrt(1.0 - std::exp(-0.5));
  for (std::size_t k = 1; k < steps.size(); ++k)
    for (const RangeBearing& one : steps[k].sightings)
      EXPECT_TRUE(near(one.sd_scale, Eigen::Vector2d::Constant(weighed), 1e-12)) << "step " << k;
}

// What the weights are for. Errors of the last pose over 40 drives, with and without them.
TEST(LastingErrors, WeightsMakeAFilterClaimLessWhereErrorsLast) {
  Drive world;
  world.odometry_noise = {0.2, 0.0, 0.0, 0.05, 0.0, 0.0};
  double plain = 0.0, weighed = 0.0;
  constexpr int kDrives = 40;
  for (std::uint64_t seed = 0; seed < kDrives; ++seed) {
    std::vector<BatchStep> steps = lasting_drive(world, seed);
    Pose truth;
    for (const Control& control : world.controls()) truth = advance(truth, control);
    const auto nees = [&] {
      Filter filter = make_filter("iekf", config_of(world), {}, 0);
      for (const BatchStep& step : steps) {
        predict(filter, step.controls[0]);
        update(filter, step.sightings);
      }
      const Estimate last = estimate(filter);
      const Eigen::Vector3d error = boxminus(last.pose, truth);
      return error.dot(last.covariance.ldlt().solve(error)) / 3.0;
    };
    plain += nees() / kDrives;
    weigh_by_gaps(config_of(world), {}, {kTime_s, 0.0}, steps);
    weighed += nees() / kDrives;
  }
  EXPECT_GT(plain, 1.5 * weighed);
  EXPECT_LT(weighed, 2.1);
}

// Mutation: a law of noise takes sightings at its word.
TEST(LastingErrors, WeighALawOfNoiseAsWell) {
  FilterConfig config;
  config.range_floor_m = config.bearing_floor_rad = 0.0;
  config.noise_law = NoiseLaw{.range_sd_m = 0.2, .range_sd_per_m2 = 0.01, .bearing_sd_rad = 0.03};
  RangeBearing seen = sighting({4.0, 0.1}, 0.1, 0.01);
  seen.sd_scale = {3.0, 2.0};
  const Observation observation = observe(seen, config);
  EXPECT_NEAR(std::sqrt(observation.noise(0, 0)), 0.6, 1e-12);
  EXPECT_NEAR(std::sqrt(observation.noise(1, 1)), 0.06, 1e-12);
  EXPECT_NEAR(observation.range_sd_per_m2, 0.03, 1e-12);
  config.noise_law.reset();
  EXPECT_NEAR(std::sqrt(observe(seen, config).noise(0, 0)), 0.3, 1e-12);
}

}  // namespace
}  // namespace stereobench::slam
