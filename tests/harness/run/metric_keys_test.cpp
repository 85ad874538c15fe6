/// Every key of run.json is explained, and every explained key occurs: held against runs that differ in their
/// sensor, in what is known of landmarks, and in where the log came from.
#include "harness/run/metric_keys.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::ordered_json;

Json run_of(std::vector<std::string> arguments) {
  const TestFolder scratch;
  arguments.insert(arguments.end(), {"--out", scratch.path().string(), "--particles", "5"});
  const Outcome outcome = run_stereobench(arguments);
  EXPECT_LE(outcome.exit_code, 1) << outcome.err;
  return Json::parse(bytes_of(scratch.path() / "run.json"));
}

/// run.json of every kind.
std::vector<Json> varied_runs() {
  const TestFolder scratch;
  const std::string data = (scratch.path() / "data").string();
  EXPECT_EQ(
      run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.06", "--out", data})
          .exit_code,
      0);
  return {run_of({"run", scenario_path("ball_circle"), "--set", "path.laps=0.1", "--seeds", "0..1"}),
          run_of({"run", scenario_path("open_field"), "--seeds", "0", "--set", "identity=colour_class",
                  "--set", "detector_noise={miss_probability: 0.1}"}),
          run_of({"run", scenario_path("open_field"), "--seeds", "0..1"}),
          run_of({"slam", data, "--seeds", "0..1"})};
}

/// The keys of a run that have a value.
std::vector<std::string> keys_with_value(const Json& run) {
  const Json all = run.flatten();
  Json with_value;
  for (const auto& [pointer, value] : all.items())
    if (!value.is_null()) with_value[pointer] = value;
  return keys_in(with_value.unflatten());
}

// Mutations: a key of run.json that no line is about; a line about a key that there never is; a path in a
// list of another form; a metric without its row in kMetrics (score.cpp).
TEST(MetricKeys, AreThoseOfResults) {
  std::set<std::string> occur, have_value;
  for (const Json& run : varied_runs()) {
    for (const std::string& key : keys_in(run)) occur.insert(key);
    for (const std::string& key : keys_with_value(run)) have_value.insert(key);
  }
  have_value.insert("filters.*.association");  // null in place of the keys below it
  for (const std::string& key : occur) EXPECT_TRUE(have_value.contains(key)) << key << " never has a value";
  std::set<std::string> explained;
  for (const MetricKey& key : metric_keys()) {
    EXPECT_TRUE(explained.insert(key.path).second) << key.path << " is explained twice";
    EXPECT_THAT(key.says, EndsWith(".")) << key.path;
  }
  std::vector<std::string> unexplained;
  std::set_difference(occur.begin(), occur.end(), explained.begin(), explained.end(),
                      std::back_inserter(unexplained));
  EXPECT_THAT(unexplained, IsEmpty()) << "add a line to harness/run/metric_keys.cpp";
  std::vector<std::string> unheard_of;
  std::set_difference(explained.begin(), explained.end(), occur.begin(), occur.end(),
                      std::back_inserter(unheard_of));
  EXPECT_THAT(unheard_of, IsEmpty()) << "remove them from harness/run/metric_keys.cpp";
}

TEST(MetricKeys, HaveTheUnitOfTheirSuffix) {
  EXPECT_EQ(unit_of("filters.*.ate_rms_m.mean"), "m");
  EXPECT_EQ(unit_of("vision.bearing_rms_rad"), "rad");
  EXPECT_EQ(unit_of("vision.disparity_rms_px"), "px");
  EXPECT_EQ(unit_of("log.odometry_delay_s"), "s");
  EXPECT_EQ(unit_of("vision.recall"), "");
  EXPECT_EQ(unit_of("seeds"), "");
}

TEST(MetricsCommand, PrintsALineForEachOrForSome) {
  const Outcome all = run_stereobench({"metrics"});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_EQ(std::count(all.out.begin(), all.out.end(), '\n'), static_cast<long>(metric_keys().size()));
  EXPECT_THAT(all.out, HasSubstr("filters.*.ate_rms_m.mean [m]: Absolute trajectory error"));
  const Outcome vision = run_stereobench({"metrics", "vision."});
  EXPECT_THAT(vision.out, testing::Not(HasSubstr("filters")));
}

}  // namespace
}  // namespace stereobench::harness
