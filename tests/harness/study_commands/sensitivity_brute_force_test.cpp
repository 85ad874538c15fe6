/// Indices of a scenario against its whole table of runs: every value of one key with every value of the
/// other, for every seed.
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using nlohmann::json;

constexpr std::size_t kTableLevels = 6;  ///< of each key, the middles of equal parts of its range
constexpr std::size_t kTableSeeds = 64;

/// A key and its range.
struct Range {
  const char* key;
  double low, high;
};

constexpr std::array<Range, 2> kRanges = {
    {{"oracle.range_sd_m", 0.05, 2.0}, {"odometry_noise.v_constant_mps", 0.02, 1.0}}};

/// Both keys matter in this drive, and so does chance: 20 m past five balls.
const std::vector<std::string> kDrivePastBalls = {
    "--set",
    "path={kind: polyline, points_m: [[-10, 0], [10, 0]], corner_radius_m: 1, speed_mps: 1, step_s: 2}",
    "--set",
    "world.balls=[{colour: 0, at_m: [0, 8, 0.5]}, {colour: 1, at_m: [12, -6, 0.5]}, "
    "{colour: 2, at_m: [25, 3, 0.5]}, {colour: 3, at_m: [8, 6, 0.5]}, {colour: 4, at_m: [-2, -5, 0.5]}]",
    "--set",
    "oracle.bearing_sd_deg=4",
    "--set",
    "filters=[ekf]",
    "--set",
    "gates=[]"};

std::vector<std::string> drive_past_balls(const std::string& name) {
  return with({name, scenario_path("open_field")}, kDrivePastBalls);
}

json result_of(const std::filesystem::path& out, const std::string& file,
               std::vector<std::string> arguments) {
  const Outcome outcome = run_stereobench(with(std::move(arguments), {"--out", out.string()}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(bytes_of(out / file));
}

/// The metric for each level of the first key, each of the second and each seed.
class TableOfRuns {
 public:
  std::array<std::size_t, 3> sizes = {kTableLevels, kTableLevels, kTableSeeds};
  std::vector<double> values;  ///< in this order

  /// The variance of the means over what is not kept.
  double variance_of_means(const std::array<bool, 3>& kept) const {
    std::vector<double> sums(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sums[place(i, kept)] += values[i];
    std::size_t groups = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) groups *= kept[axis] ? sizes[axis] : 1;
    const double members = static_cast<double>(values.size() / groups);
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double sum = 0.0;
    for (std::size_t group = 0; group < groups; ++group) sum += std::pow(sums[group] / members - mean, 2);
    return sum / static_cast<double>(groups);
  }

 private:
  /// The number of the group that a value is in.
  std::size_t place(std::size_t index, const std::array<bool, 3>& kept) const {
    const std::array<std::size_t, 3> at = {index / (sizes[1] * sizes[2]), index / sizes[2] % sizes[1],
                                           index % sizes[2]};
    std::size_t group = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (kept[axis]) group = group * sizes[axis] + at[axis];
    return group;
  }
};

TableOfRuns run_table(const TestFolder& scratch) {
  const auto level = [](const Range& range, std::size_t k) {
    const double share = (static_cast<double>(k) + 0.5) / kTableLevels;
    return fmt::format("{}={}", range.key, range.low + (range.high - range.low) * share);
  };
  TableOfRuns table;
  for (std::size_t i = 0; i < kTableLevels; ++i)
    for (std::size_t j = 0; j < kTableLevels; ++j) {
      const auto out = scratch.path() / fmt::format("{}_{}", i, j);
      // Seeds that the study does not have: it counts from 0.
      const json run = result_of(
          out, "run.json",
          with(drive_past_balls("run"), {"--seeds", fmt::format("100000..{}", 100000 + kTableSeeds - 1),
                                         "--set", level(kRanges[0], i), "--set", level(kRanges[1], j)}));
      for (const json& value : run["per_seed"]["filters.ekf.ate_rms_m"]) table.values.push_back(value);
    }
  return table;
}

/// The value of an index lies in its 95 % interval, or within half of its width beside it: 4 standard errors.
void expect_index(const json& index, double value, const std::string& name) {
  const double low = index["low"], high = index["high"], slack = 0.5 * (high - low);
  EXPECT_GT(value, low - slack) << name << " " << index.dump();
  EXPECT_LT(value, high + slack) << name << " " << index.dump();
  EXPECT_LT(high - low, 0.25) << name;
}

// First indices of the table are 0.29 of the range noise and 0.34 of the seed, whose total one is 0.53.
// Mutations: keys get each other's values; the total index as the first; a seed that is not swapped; a column
// in another's place.
TEST(SensitivityCommand, FindsWhatATableOfAllRunsHas) {
  const TestFolder scratch;
  const TableOfRuns table = run_table(scratch);
  ASSERT_EQ(table.values.size(), kTableLevels * kTableLevels * kTableSeeds);
  std::vector<std::string> words =
      with(drive_past_balls("sensitivity"), {"--metric", "filters.ekf.ate_rms_m", "--samples", "512"});
  for (const Range& range : kRanges)
    words = with(words, {"--vary", fmt::format("{}={}..{}", range.key, range.low, range.high)});
  const json study = result_of(scratch.path() / "study", "sensitivity.json", words);
  const double variance = table.variance_of_means({true, true, true});
  for (std::size_t factor = 0; factor < 3; ++factor) {
    std::array<bool, 3> alone = {}, others = {true, true, true};
    alone[factor] = true;
    others[factor] = false;
    const json& found = study["factors"][factor];
    expect_index(found["first"], table.variance_of_means(alone) / variance, found.dump());
    expect_index(found["total"], 1.0 - table.variance_of_means(others) / variance, found.dump());
  }
}

}  // namespace
}  // namespace stereobench::harness
