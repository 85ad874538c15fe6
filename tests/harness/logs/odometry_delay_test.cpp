#include "harness/logs/odometry_delay.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "harness/logs/measurement_log_reader.h"
#include "slam/math/random.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kMilli = 1'000'000;

/// How a synthetic robot drives and what its log says.
struct Drive {
  double delay_s = 0.0;          ///< by which the motion follows the odometry
  double turn_radps = 0.4;       ///< the fastest
  std::int64_t apart_ms = 120;   ///< between sightings
  double bearing_sd_rad = 0.01;  ///< of the sensor
  double outlier_share = 0.02;   ///< of bearings that are anything
  bool says_which = true;        ///< whether landmarks are identified
};

/// Five minutes of turns to and fro among landmarks all around, odometry at 50 Hz with a scale error of 4 %.
RecordedStreams drive(const Drive& how, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  RecordedStreams streams;
  slam::Pose pose;
  double turn_radps = 0.0;
  for (std::int64_t ms = 0; ms < 300'000; ms += 20) {
    if (ms % 1500 == 0) turn_radps = how.turn_radps * (2.0 * random.uniform() - 1.0);
    if (ms % how.apart_ms < 20) {
      const int id = static_cast<int>(ms / 3000 % 7);
      const Eigen::Vector2d place(6.0 * std::cos(id), 6.0 * std::sin(id));
      const Eigen::Vector2d seen = slam::predict_sighting(pose, place);
      LoggedSighting sighting{ms * kMilli, {}};
      sighting.measurement.range_m = seen.x() + 0.1 * random.normal();
      sighting.measurement.bearing_rad = slam::wrap_angle(
          random.uniform() < how.outlier_share ? 6.0 * random.uniform()
                                               : seen.y() + how.bearing_sd_rad * random.normal());
      if (how.says_which) sighting.measurement.landmark_id = id;
      streams.sightings.push_back(sighting);
    }
    const std::int64_t said_ns = ms * kMilli - std::llround(1e9 * how.delay_s);
    streams.odometry.push_back({said_ns, 0.1, 1.04 * turn_radps});
    pose = slam::advance(pose, {0.1, turn_radps, 0.02});
  }
  return streams;
}

class DelaysAndSeeds : public testing::TestWithParam<std::tuple<double, int>> {};

// Mutations: the delay's sign, the first of the pair as the later one, squares in place of absolute errors.
TEST_P(DelaysAndSeeds, AreFound) {
  const auto [delay_s, seed] = GetParam();
  const Drive how{.delay_s = delay_s};
  EXPECT_NEAR(estimate_odometry_delay(drive(how, static_cast<std::uint64_t>(seed))).delay_s, delay_s, 0.0201);
}

INSTANTIATE_TEST_SUITE_P(OdometryDelay, DelaysAndSeeds,
                         testing::Combine(testing::Values(-0.2, 0.1, 0.25, 0.6), testing::Range(0, 5)));

testing::AssertionResult is_zero_since(const RecordedStreams& streams, DelaySource source) {
  const OdometryDelay delay = estimate_odometry_delay(streams);
  if (delay.delay_s == 0.0 && delay.source == source) return testing::AssertionSuccess();
  return testing::AssertionFailure() << delay.delay_s << " s, from source " << static_cast<int>(delay.source);
}

// Mutation: any improvement is believed.
TEST(OdometryDelay, IsZeroWhereThereIsNone) {
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    EXPECT_TRUE(is_zero_since(drive({}, seed), DelaySource::kNoneBetter));
}

// Mutations: a log without identities passes for one of few pairs, or for one that was heard.
TEST(OdometryDelay, IsZeroWhereTheLogCannotTellAndSaysWhy) {
  EXPECT_TRUE(is_zero_since(drive({.delay_s = 0.3, .turn_radps = 0.0}, 1), DelaySource::kNoneBetter));
  EXPECT_TRUE(is_zero_since(drive({.delay_s = 0.3, .apart_ms = 2000}, 1), DelaySource::kFewPairs));
  EXPECT_TRUE(is_zero_since(drive({.delay_s = 0.3, .says_which = false}, 1), DelaySource::kNoIdentities));
  EXPECT_TRUE(is_zero_since({.odometry = {{0, 0.0, 0.0}}}, DelaySource::kFewPairs));
}

TEST(OdometryDelay, PutsReadingsBesideTheirMotion) {
  RecordedStreams late = drive({.delay_s = 0.24}, 2);
  delay_odometry(late.odometry, 0.24);
  const RecordedStreams right = drive({}, 2);
  for (std::size_t i = 0; i < right.odometry.size(); ++i)
    ASSERT_EQ(late.odometry[i].stamp_ns, right.odometry[i].stamp_ns);
  EXPECT_TRUE(is_zero_since(late, DelaySource::kNoneBetter));
}

// MRCLAM's odometry is what the robot was told to do. Against the motion capture both robots follow 0.2 to
// 0.3 s later (the lag at which its turn rate correlates best); here only sightings are asked.
TEST(OdometryDelay, OfRealRobotsAgreesWithMotionCapture) {
  const auto data = std::filesystem::path(STEREOBENCH_SOURCE_DIR) / ".." / "shared" / "data" / "mrclam";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no MRCLAM data beside this checkout";
  for (const char* log : {"ds7/robot2", "ds7/robot5"})
    EXPECT_NEAR(read_log(data / log, {}).facts.odometry_delay_s, 0.25, 0.051) << log;
  EXPECT_EQ(read_log(data / "ds7/robot5", {.odometry_delay_s = 0.1}).facts.odometry_delay_s, 0.1);
}

TEST(OdometryDelay, BeyondAMinuteIsRefused) {
  EXPECT_THROW(read_log(".", {.odometry_delay_s = 61.0}), std::invalid_argument);
  EXPECT_THROW(read_log(".", {.odometry_delay_s = std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
