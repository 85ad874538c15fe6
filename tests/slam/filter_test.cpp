// The contract that every filter keeps.
#include <limits>
#include <stdexcept>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/filter_registry.h"
#include "tests/slam/checks.h"
#include "tests/slam/tested_filters.h"

namespace stereobench::slam {
namespace {

/// All rows of the registry.
class EveryFilter : public ::testing::TestWithParam<TestedFilter> {};
INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, ::testing::ValuesIn(tested_filters(filter_names())),
                         ::testing::PrintToStringParamName());

/// Those that map landmarks.
class MappingFilter : public EveryFilter {};
INSTANTIATE_TEST_SUITE_P(Filters, MappingFilter, ::testing::ValuesIn(mapping_filters()),
                         ::testing::PrintToStringParamName());

/// Those that trust in odometry where nothing is seen: a blind filter other than dead reckoning moves as it
/// likes.
class OdometryFilter : public EveryFilter {};
std::vector<TestedFilter> odometry_filters() {
  std::vector<TestedFilter> filters = mapping_filters();
  filters.push_back({"dead_reckoning"});
  return filters;
}
INSTANTIATE_TEST_SUITE_P(Filters, OdometryFilter, ::testing::ValuesIn(odometry_filters()),
                         ::testing::PrintToStringParamName());

FilterConfig config_for(const Drive& world, int particles = 30) {
  FilterConfig config;
  config.particles = particles;
  config.odometry_noise = world.odometry_noise;
  return config;
}

bool same(const Estimate& a, const Estimate& b) {
  bool equal =
      near(a.pose, b.pose, 0.0) && a.covariance == b.covariance && a.landmarks.size() == b.landmarks.size();
  for (std::size_t i = 0; equal && i < a.landmarks.size(); ++i) {
    equal = a.landmarks[i].position_m == b.landmarks[i].position_m &&
            a.landmarks[i].covariance == b.landmarks[i].covariance;
  }
  return equal;
}

bool is_covariance(const Eigen::MatrixXd& matrix) {
  const double scale = matrix.cwiseAbs().maxCoeff();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()(0);
  return (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * scale && least >= -1e-9 * scale;
}

TEST_P(EveryFilter, StartsWhereItIsTold) {
  const Estimate first = estimate(GetParam().make({}, {1.0, 2.0, 3.0}));
  EXPECT_TRUE(near(first.pose, Pose{1.0, 2.0, 3.0}, 0.0));
  EXPECT_EQ(first.covariance.norm(), 0.0);
  EXPECT_TRUE(first.landmarks.empty());
}

// No noise: every filter is dead reckoning, and dead reckoning is the truth, to rounding.
TEST_P(OdometryFilter, WithoutOdometryNoiseIsExactDeadReckoning) {
  Drive world;
  world.odometry_noise = {};
  const DriveScore score = drive(GetParam().make(config_for(world)), world, 3);
  EXPECT_LE(score.rms_m, 1e-11 + GetParam().least_sd());
  const double grown_sd = static_cast<double>(world.controls().size()) * GetParam().least_sd();
  EXPECT_LE(score.last.covariance.norm(), 1e-20 + 100.0 * grown_sd * grown_sd);  // a lever of 10 m
}

TEST_P(EveryFilter, IsAValueThatRepeatsItself) {
  const Drive world;
  const Filter filter = GetParam().make(config_for(world));
  const DriveScore once = drive(filter, world, 4);
  const DriveScore again = drive(filter, world, 4);  // a copy: the first drive has left no trace
  EXPECT_TRUE(same(once.last, again.last));
}

TEST_P(EveryFilter, BelievesInSemidefiniteCovariances) {
  const Drive world;
  const Estimate last = drive(GetParam().make(config_for(world)), world, 5).last;
  EXPECT_TRUE(is_covariance(last.covariance));
  for (const LandmarkEstimate& landmark : last.landmarks) EXPECT_TRUE(is_covariance(landmark.covariance));
}

// Noisy odometry leaves nobody sure of where they are: without a covariance of the path nothing would score
// what a filter claims. Mutation: dead reckoning's covariance left out of its estimate.
TEST_P(EveryFilter, DoubtsItsPoseAfterANoisyMotion) {
  Filter filter = GetParam().make(config_for(Drive{}));
  for (int i = 0; i < 5; ++i) predict(filter, {1.0, 0.2, 0.5});
  const Eigen::Matrix3d covariance = estimate_without_map(filter).covariance;
  EXPECT_TRUE(is_covariance(covariance));
  EXPECT_GT(covariance.diagonal().minCoeff(), 0.0);
}

TEST_P(EveryFilter, AFrameWithoutSightingsIsNoFrame) {
  const Drive world;
  Filter a = GetParam().make(config_for(world));
  Filter b = a;
  for (int i = 0; i < 10; ++i) {
    predict(a, {1.0, 0.2, 0.5});
    predict(b, {1.0, 0.2, 0.5});
    update(a, {});
  }
  EXPECT_TRUE(same(estimate(a), estimate(b)));
}

TEST_P(EveryFilter, IgnoresAndCountsWhatCannotBe) {
  const Drive world;
  Filter clean = GetParam().make(config_for(world));
  Filter dirty = clean;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RangeBearing good = [] {
    RangeBearing seen = sighting({2.0, 0.1}, 0.1, 0.01);
    seen.landmark_id = 7;
    return seen;
  }();
  RangeBearing bad = good;
  bad.bearing_rad = nan;
  for (int i = 0; i < 5; ++i) {
    predict(clean, {1.0, 0.2, 0.1});
    predict(dirty, {1.0, 0.2, 0.1});
    predict(dirty, {nan, 0.2, 0.1});
    predict(dirty, {1.0, 0.2, -0.1});
    update(clean, std::vector<RangeBearing>{good});
    update(dirty, std::vector<RangeBearing>{bad, good});
  }
  EXPECT_TRUE(same(estimate(clean), estimate(dirty)));
  EXPECT_EQ(estimate(dirty).counters.rejected_inputs, 15);
  EXPECT_EQ(estimate(clean).counters.rejected_inputs, 0);
}

// The covariance between updates is the odometry's. Against 20,000 drives; catches variances taken for
// deviations when FastSLAM predicts, and a motion along the old heading.
TEST_P(OdometryFilter, PredictsTheSpreadOfManyDrives) {
  FilterConfig config;
  config.odometry_noise = {0.05, 0.0, 0.0, 0.03, 0.0, 0.0};
  Filter filter = GetParam().make(config, {1.0, 1.0, 2.0});
  const Control control{1.0, 0.2, 0.5};
  for (int i = 0; i < 10; ++i) predict(filter, control);
  const Estimate believed = estimate(filter);
  constexpr int kDrives = 20000;
  RandomStream random(8, Stream::kOdometry);
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDrives; ++i) {
    Pose pose{1.0, 1.0, 2.0};
    for (int k = 0; k < 10; ++k) pose = advance(pose, perturb(control, config.odometry_noise, random));
    const Eigen::Vector3d off = boxminus(pose, believed.pose);
    second += off * off.transpose() / kDrives;
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(believed.covariance(i, i) / second(i, i), 1.0, 0.07);
}

// One to thirty particles and noise from a millionth to a million times what it should be: never NaN, never a
// throw.
TEST_P(EveryFilter, SurvivesExtremes) {
  for (const int particles : {1, 2, 3, 30}) {
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      Drive believed;
      believed.odometry_noise.v_constant_mps *= scale;
      believed.odometry_noise.w_constant_radps *= scale;
      Drive world;
      world.range_sd_m *= std::min(scale, 10.0);
      world.side_m = 8.0;
      const DriveScore score = drive(GetParam().make(config_for(believed, particles)), world, 9);
      EXPECT_TRUE(all_finite(score.last)) << particles << " particles, scale " << scale;
      EXPECT_TRUE(score.last.effective_particles >= 1.0);
    }
  }
}

// Range 0, one landmark twice in a frame, huge and no noise, all in one frame, over and over.
TEST_P(EveryFilter, SurvivesImpossibleFrames) {
  for (const double sd : {0.0, 1e-6, 1.0, 1e6}) {
    Filter filter = GetParam().make(config_for(Drive{}, 10));
    for (int i = 0; i < 30; ++i) {
      std::vector<RangeBearing> frame = {sighting({0.0, 1.0}, sd, sd), sighting({0.0, -1.0}, sd, sd),
                                         sighting({3.0, M_PI}, sd, sd), sighting({1e6, 0.0}, sd, sd)};
      const int ids[] = {1, 1, 2, 3};
      for (std::size_t k = 0; k < 4; ++k) frame[k].landmark_id = ids[k];
      frame.push_back(sighting({2.0, 0.3}, sd, sd));  // neither identity nor colour
      predict(filter, {1.0, i % 2 == 0 ? 0.0 : 3.0, 0.5});
      update(filter, frame);
    }
    EXPECT_TRUE(all_finite(estimate(filter))) << "sd " << sd;
  }
}

TEST_P(EveryFilter, CheaperEstimateIsTheSameWithoutMap) {
  const Drive world;
  Filter filter = GetParam().make(config_for(world));
  RandomStream random(1, Stream::kOracle);
  update(filter, world.look({}, random));
  EXPECT_TRUE(near(estimate(filter).pose, estimate_without_map(filter).pose, 0.0));
  EXPECT_TRUE(estimate_without_map(filter).landmarks.empty());
}

// Twelve drives, mean against mean: with landmarks the error is less than half of dead reckoning's (a fifth
// is usual), and the map is as good as the pose. Catches a bearing or gain with the wrong sign, and maps that
// are mixed up.
TEST_P(MappingFilter, IsFarBetterThanDeadReckoning) {
  Drive world;
  world.laps = 2;
  double filtered = 0.0;
  double reckoned = 0.0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const DriveScore score = drive(GetParam().make(config_for(world), {}, seed), world, seed);
    filtered += score.rms_m;
    reckoned += drive(make_filter("dead_reckoning", config_for(world), {}, seed), world, seed).rms_m;
    EXPECT_EQ(score.last.landmarks.size(), world.landmarks().size());
    EXPECT_LE(score.map_rms_m, 1.2);  // FastSLAM 1.0 has 1.07 m in one drive
  }
  EXPECT_LE(filtered, 0.5 * reckoned);
}

// A landmark found after a noisy move is as uncertain as the move and the sighting together. A public
// implementation never draws its proposal; then all particles agree and the landmark is as sure as the
// sighting alone. Another draws from the inverse of the covariance. Mutations: both.
TEST_P(MappingFilter, DrawsEveryParticlesPose) {
  FilterConfig config;
  config.particles = 4000;
  config.odometry_noise = {0.2, 0.0, 0.0, 0.0, 0.0, 0.0};
  Filter filter = GetParam().make(config);
  predict(filter, {1.0, 0.0, 1.0});
  RangeBearing seen = sighting({2.0, 0.0}, 0.1, 0.01);
  seen.landmark_id = 1;
  update(filter, std::vector<RangeBearing>{seen});
  const Estimate after = estimate(filter);
  const double relative_error = 5.0 * std::sqrt(2.0 / 4000.0);  // five standard errors
  EXPECT_NEAR(after.landmarks.at(0).covariance(0, 0) / (0.04 + 0.01), 1.0, relative_error);
  EXPECT_NEAR(after.covariance(0, 0) / 0.04, 1.0, relative_error);
}

// A landmark seen again from the same place pins its range: the fused error is the textbook's.
TEST_P(MappingFilter, FusesRepeatedSightings) {
  FilterConfig config;
  config.particles = 5;
  Filter filter = GetParam().make(config);
  RangeBearing seen = sighting({2.0, 0.5}, 0.1, 0.01);
  seen.landmark_id = 1;
  for (int i = 0; i < 25; ++i) update(filter, std::vector<RangeBearing>{seen});
  const Eigen::Matrix2d covariance = estimate(filter).landmarks.at(0).covariance;
  EXPECT_NEAR(std::sqrt(covariance.eigenvalues().real().maxCoeff()), 0.1 / 5.0, 0.001);
}

TEST_P(MappingFilter, PutsALandmarkSeenTwiceInAFrameIntoTheMapOnce) {
  Filter filter = GetParam().make({});
  RangeBearing seen = sighting({2.0, 0.5}, 0.1, 0.01);
  seen.landmark_id = 5;
  update(filter, std::vector<RangeBearing>{seen, seen});
  ASSERT_EQ(estimate(filter).landmarks.size(), 1u);
  EXPECT_EQ(estimate(filter).landmarks[0].landmark_id, 5);
}

// How far a filter is off at worst, in a drive in which ten per cent of the sightings are a metre and a half
// too long.
double worst_among_outliers(Filter& filter, const Drive& world, std::uint64_t seed) {
  RandomStream odometry(seed, Stream::kOdometry);
  RandomStream sensor(seed, Stream::kOracle);
  Pose truth;
  double worst_m = 0.0;
  for (const Control& control : world.controls()) {
    truth = advance(truth, control);
    predict(filter, perturb(control, world.odometry_noise, odometry));
    std::vector<RangeBearing> frame = world.look(truth, sensor);
    for (RangeBearing& seen : frame) seen.range_m += sensor.uniform() < 0.1 ? 1.5 : 0.0;
    update(filter, frame);
    const Pose pose = estimate_without_map(filter).pose;
    worst_m = std::fmax(worst_m, std::hypot(pose.x_m - truth.x_m, pose.y_m - truth.y_m));
  }
  return worst_m;
}

// Five drives, mean against mean: outliers do not take away what landmarks give. Catches a gate that lets
// them through or kills the filter.
TEST_P(MappingFilter, PassesOverOutliers) {
  const Drive world;
  double filtered = 0.0;
  double reckoned = 0.0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Filter filter = GetParam().make(config_for(world), {}, seed);
    Filter reckoning = make_filter("dead_reckoning", config_for(world), {}, 0);
    filtered += worst_among_outliers(filter, world, seed);
    reckoned += worst_among_outliers(reckoning, world, seed);
    EXPECT_GT(estimate(filter).counters.gated_measurements, 100);
  }
  EXPECT_LE(filtered, 0.5 * reckoned);
}

TEST(MakeFilter, KnowsItsNamesAndRefusesTheRest) {
  for (const std::string& name : filter_names()) EXPECT_NO_THROW(make_filter(name, {}, {}, 0));
  try {
    make_filter("kalman", {}, {}, 0);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& name : filter_names()) EXPECT_THAT(error.what(), ::testing::HasSubstr(name));
  }
}

TEST(MakeFilter, RefusesSettingsThatCannotBe) {
  const auto refuses = [](auto change) {
    FilterConfig config;
    change(config);
    try {
      make_filter("fastslam2", config, {}, 0);
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.particles = 0; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.draw_every = 0; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.odometry_noise.v_per_v = -1.0; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.range_floor_m = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.noise_law = {.range_sd_per_m2 = -1.0}; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.resample_below = 1.5; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.gate_probability = 0.0; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.colour_spacing_m = -1.0; }));
  EXPECT_TRUE(refuses([](FilterConfig& c) { c.unscented.alpha = 0.0; }));
  EXPECT_THROW(make_filter("fastslam2", {}, {std::numeric_limits<double>::infinity(), 0.0, 0.0}, 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::slam
