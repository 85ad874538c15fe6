#include "harness/logs/sighting_weights.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

// Ranges of MRCLAM's cameras are off by the same for seconds, which motion capture shows as well (0.93 from
// one sighting to the next); their bearings are not. Here only sightings are asked. Mutations: ranges and
// bearings exchanged; nothing found; weights that reach no sighting.
TEST(SightingWeights, OfRealCamerasAgreeWithMotionCapture) {
  const auto data = std::filesystem::path(STEREOBENCH_SOURCE_DIR) / ".." / "shared" / "data" / "mrclam";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no MRCLAM data beside this checkout";
  slam::FilterConfig config;
  config.odometry_noise = {.v_constant_mps = 0.01, .w_constant_radps = 0.02, .correlation_s = 1.0};
  for (const char* log : {"ds7/robot2", "ds7/robot5"}) {
    RecordedLog recorded = read_log(data / log, {});
    weigh_sightings(recorded, config, std::nullopt);
    EXPECT_NEAR(recorded.facts.lasting_errors.correlation[0], 0.90, 0.05) << log;
    EXPECT_EQ(recorded.facts.lasting_errors.time_s[1], 0.0) << log;
    double largest = 0.0;
    for (const LogStep& step : recorded.log.steps)
      for (const slam::RangeBearing& seen : step.measurements) largest = std::max(largest, seen.sd_scale[0]);
    EXPECT_GT(largest, 3.0);
  }
}

// Mutations: what is stated not used; errors that are said to be their own looked for all the same.
TEST(SightingWeights, AreThoseThatTheCallerStates) {
  const TestFolder folder;
  write_small_csv_log(folder);
  const RecordedLog log = read_log(folder.path() / "log", {});
  const auto largest_scale = [&](const Eigen::Vector2d& time_s) {
    RecordedLog weighed = log;
    weigh_sightings(weighed, {}, time_s);
    EXPECT_EQ(weighed.facts.lasting_errors.time_s, time_s);
    Eigen::Vector2d largest = Eigen::Vector2d::Zero();
    for (const LogStep& step : weighed.log.steps)
      for (const slam::RangeBearing& seen : step.measurements) largest = largest.cwiseMax(seen.sd_scale);
    return largest;
  };
  EXPECT_EQ(largest_scale({0.0, 0.0}), Eigen::Vector2d::Ones());
  EXPECT_GT(largest_scale({5.0, 0.0})[0], 1.0);
  EXPECT_EQ(largest_scale({5.0, 0.0})[1], 1.0);
}

}  // namespace
}  // namespace stereobench::harness
