#include "harness/run/seed_metrics.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// The number or summary at a name; null where there is none.
Json at(const Json& run, std::string name) {
  for (char& c : name)
    if (c == '.') c = '/';
  const Json::json_pointer pointer("/" + name);
  return run.contains(pointer) ? run.at(pointer) : Json();
}

double sum_of(const Json& list) {
  return std::accumulate(list.begin(), list.end(), 0.0,
                         [](double sum, const Json& value) { return sum + value.get<double>(); });
}

// Law: means over seeds and sums over seeds are those of the seeds' own values. Rates and rms errors of
// pictures are of all detections together, and no mean over seeds.
// Mutations: a summary's spread in place of its mean; a count of all seeds so far.
TEST(SeedMetrics, AddUpToTheRun) {
  const TestFolder scratch;
  const std::string out = (scratch.path() / "out").string();
  const Outcome outcome =
      run_stereobench({"run", scenario_path("open_field"), "--seeds", "0..3", "--particles", "5", "--filters",
                       "fastslam2", "--set", "gates=[]", "--out", out});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json run = Json::parse(bytes_of(out + "/run.json"));
  int means = 0;
  int counts = 0;
  for (const auto& [name, values] : run.at("per_seed").items()) {
    ASSERT_EQ(values.size(), 4U) << name;
    const Json whole = at(run, name);
    if (whole.is_object() && !whole.at("mean").is_null()) {
      const double mean = 0.25 * sum_of(values);
      EXPECT_NEAR(whole.at("mean").get<double>(), mean, 1e-12 * std::abs(mean)) << name;
      ++means;
    } else if (whole.is_number_integer()) {
      EXPECT_EQ(whole.get<double>(), sum_of(values)) << name;
      ++counts;
    }
  }
  EXPECT_GE(means, 40);
  EXPECT_GE(counts, 15);
}

/// One filter's run.
SeedResult seed_of(double ate_m) {
  SeedResult seed;
  seed.runs.push_back({.filter = "ekf"});
  seed.runs.back().score.trajectory.ate_rms_m = ate_m;
  return seed;
}

// Mutation: values of later seeds that move up to where earlier seeds have none.
TEST(SeedMetrics, HaveNoValueWhereTheSeedHasNone) {
  SeedMetricsTally tally;
  SeedResult lost = seed_of(std::nan(""));
  lost.runs.back().score.failed = true;
  for (const SeedResult& seed : {lost, seed_of(0.5), lost}) tally.add(seed);
  const std::vector<double>& ate_m = tally.metrics().at("filters.ekf.ate_rms_m");
  ASSERT_EQ(ate_m.size(), 3U);
  EXPECT_TRUE(std::isnan(ate_m[0]) && std::isnan(ate_m[2]));
  EXPECT_EQ(ate_m[1], 0.5);
  EXPECT_EQ(tally.metrics().at("filters.ekf.failures"), (std::vector{1.0, 0.0, 1.0}));
  EXPECT_EQ(seed_metrics_json(tally.metrics())["filters.ekf.ate_rms_m"].dump(), "[null,0.5,null]");
}

}  // namespace
}  // namespace stereobench::harness
