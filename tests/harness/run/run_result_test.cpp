#include "harness/run/run_result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "harness/io/text_table.h"
#include "harness/run/result_table.h"
#include "tests/harness/run/assemble.h"

namespace stereobench::harness {
namespace {

/// A drive along x of some steps; dead reckoning is `slip_m` beside it, the other filter a quarter of that,
/// the batch an eighth. The filtering bound has a position rms of 0.01 m, the smoothing bound half of it.
SeedDrive drive_of(std::uint64_t seed, std::size_t steps, double slip_m) {
  SeedDrive drive{.seed = seed};
  drive.references.batch.filter = "batch";
  drive.references.bound.emplace();
  for (const char* filter : {"dead_reckoning", "ufastslam"})
    drive.runs.push_back({.filter = filter, .particles = 5, .seed = seed});
  for (std::size_t k = 0; k < steps; ++k) {
    const double x_m = static_cast<double>(k);
    drive.recording.log.steps.push_back(
        {.stamp_ns = static_cast<std::int64_t>(k) * 100, .truth = slam::Pose{x_m, 0.0, 0.0}});
    for (FilterRun& run : drive.runs) {
      run.poses.push_back({x_m, run.filter == "ufastslam" ? slip_m / 4.0 : slip_m, 0.0});
      run.covariances.push_back(Eigen::Matrix3d::Identity());
    }
    drive.references.batch.poses.push_back({x_m, slip_m / 8.0, 0.0});
    drive.references.batch.covariances.push_back(Eigen::Matrix3d::Zero());
    drive.references.bound->poses.push_back(Eigen::Vector3d(0.00005, 0.00005, 0.04).asDiagonal());
    drive.references.bound->smoothed_poses.push_back(0.25 * drive.references.bound->poses.back());
  }
  return drive;
}

std::set<std::string> keys_of(const nlohmann::ordered_json& json) {
  std::set<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.insert(key);
  return keys;
}

// Mutations: a clock in it; the number of jobs in it.
TEST(RunResult, JsonSaysNothingThatOneRunAndTheNextDifferIn) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  const RunResult result = assemble("name", "none", drives);
  const auto json = run_json(result);
  EXPECT_EQ(keys_of(json), (std::set<std::string>{"schema", "scenario", "seeds", "renderer", "detector",
                                                  "vision", "bound", "smoothing_bound", "batch", "noise",
                                                  "filters", "comparisons", "per_seed"}));
  EXPECT_EQ(keys_of(json["renderer"]), (std::set<std::string>{"backend", "blur"}));
  for (SeedDrive& drive : drives) drive.recording.timing["render"] = 123.0;
  EXPECT_EQ(run_json(assemble("name", "none", drives)), json);
}

// Mutations: the first seed alone; steps summed; blur of pictures that nobody rendered.
TEST(RunResult, JsonSaysHowCoarseTheBlurOfAllSeedsIs) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  drives[0].recording.blur = {.pairs = 2, .most_step_px = 1.5};
  drives[1].recording.blur = {.pairs = 3, .most_step_px = 2.5};
  const auto blur = run_json(assemble("name", "osmesa", drives))["renderer"]["blur"];
  EXPECT_EQ(blur["coarse_pairs"], 5);
  EXPECT_EQ(blur["most_step_px"], 2.5);
  const auto without = run_json(assemble("name", kNoBackend, drives))["renderer"]["blur"];
  EXPECT_EQ(keys_of(without), keys_of(blur));
  for (const auto& value : without) EXPECT_TRUE(value.is_null());
}

// Mutations: two counts that change places; a line where nobody named faults; the first seed alone.
TEST(RunResult, SaysWhatTheFaultsOfTheDetectorDid) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  EXPECT_EQ(result_table(assemble("name", "none", drives)).find("detector_noise"), std::string::npos);
  drives[0].recording.faults = FaultCounts{1, 2, 3, 4, 5, 6};
  drives[1].recording.faults = FaultCounts{10, 20, 30, 40, 50, 60};
  const std::string table = result_table(assemble("name", "none", drives));
  EXPECT_NE(
      table.find("\ndetector_noise: 11 moved, 22 lost, 33 added, 44 renamed, 55 delayed, 66 undelivered\n"),
      std::string::npos)
      << table;
}

// Errors of 0.8 and 0.2 m, of which 0.2 m is claimed: the first is four times as large. Mutations: the
// variance's ratio in place of the deviation's; a warning for all.
TEST(RunResult, WarnsOfFiltersThatClaimFarTooLittleOrTooMuch) {
  SeedDrive drive = drive_of(3, 4, 0.8);
  for (FilterRun& run : drive.runs)
    for (Eigen::Matrix3d& covariance : run.covariances) covariance *= 0.04 / 3.0;
  const std::string table = result_table(assemble("name", "none", std::vector{drive}));
  EXPECT_NE(table.find("warning: dead_reckoning makes errors 4.0 times as large as it claims (ANEES 16"),
            std::string::npos)
      << table;
  EXPECT_EQ(table.find("warning: ufastslam"), std::string::npos);
  for (Eigen::Matrix3d& covariance : drive.runs[1].covariances) covariance *= 25.0;
  EXPECT_NE(result_table(assemble("name", "none", std::vector{drive}))
                .find("warning: ufastslam claims errors 5.0 times"),
            std::string::npos);
}

// Mutation: the ratio upside down.
TEST(RunResult, FiltersAreComparedWithDeadReckoning) {
  const std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  const auto json = run_json(assemble("name", "none", drives));
  EXPECT_EQ(json["seeds"], (std::vector<int>{3, 8}));
  EXPECT_DOUBLE_EQ(json["filters"]["dead_reckoning"]["ate_rms_m"]["mean"], 0.6);
  EXPECT_DOUBLE_EQ(json["filters"]["ufastslam"]["ate_rms_m"]["mean"], 0.15);
  EXPECT_DOUBLE_EQ(json["filters"]["ufastslam"]["ate_over_dead_reckoning"], 0.25);
  EXPECT_EQ(json["filters"]["ufastslam"]["failures"], 0);
}

// Mutations: the batch's error among the filters; a bound's heading for its position; the ratio upside down;
// the batch held against the filtering bound, which it beats by knowing the future.
TEST(RunResult, FiltersAreHeldAgainstTheBoundAndTheBatch) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  const auto json = run_json(assemble("name", "none", drives));
  EXPECT_DOUBLE_EQ(json["bound"]["pose_rms_m"]["mean"], 0.01);
  EXPECT_DOUBLE_EQ(json["bound"]["heading_rms_rad"]["max"], 0.2);
  EXPECT_DOUBLE_EQ(json["batch"]["ate_rms_m"]["mean"], 0.075);
  EXPECT_EQ(json["batch"]["failures"], 0);
  EXPECT_FALSE(json["filters"].contains("batch"));
  EXPECT_NEAR(json["filters"]["ufastslam"]["efficiency"], 0.25 * std::sqrt((0.16 + 0.64) / 2.0) / 0.01, 1e-9);
  EXPECT_DOUBLE_EQ(json["smoothing_bound"]["pose_rms_m"]["mean"], 0.005);
  EXPECT_DOUBLE_EQ(json["smoothing_bound"]["heading_rms_rad"]["max"], 0.1);
  EXPECT_NEAR(json["batch"]["efficiency"], 0.125 * std::sqrt((0.16 + 0.64) / 2.0) / 0.005, 1e-9);
}

// Mutation: leaving out the keys, which gates may name.
TEST(RunResult, WithoutABoundItAndTheEfficiencyAreNull) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  for (SeedDrive& drive : drives) drive.references.bound.reset();
  const RunResult result = assemble("name", "none", drives);
  const auto json = run_json(result);
  for (const char* part : {"pose_rms_m", "heading_rms_rad", "landmark_rms_m"})
    EXPECT_TRUE(json["bound"].at(part).at("mean").is_null());
  EXPECT_TRUE(json["filters"]["ufastslam"].at("efficiency").is_null());
  EXPECT_EQ(result_table(result).find("\nbound "), std::string::npos);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The index of the line that starts with a name; the number of lines where there is none.
std::size_t line_of(const std::vector<std::string>& lines, const std::string& name) {
  const auto is_it = [&](const std::string& line) { return line.starts_with(name); };
  return static_cast<std::size_t>(std::ranges::find_if(lines, is_it) - lines.begin());
}

// A batch that "beats the bound" of filters is no wonder. Mutations: either bound at the other's place; the
// batch's ratio to the filtering bound, 10.
TEST(RunResult, EachEstimatorStandsAboveTheBoundOfWhatItKnows) {
  const auto lines = lines_of(result_table(assemble("name", "none", std::vector{drive_of(3, 4, 0.8)})));
  const std::size_t filter = line_of(lines, "ufastslam");
  ASSERT_LT(filter + 3, lines.size());
  EXPECT_TRUE(lines[filter + 1].starts_with("bound (filtering) "));
  EXPECT_TRUE(lines[filter + 2].starts_with("batch "));
  EXPECT_TRUE(lines[filter + 3].starts_with("bound (smoothing) "));
  EXPECT_NE(lines[filter].find(" 20.0 "), std::string::npos) << "0.2 m over 0.01 m";
  EXPECT_NE(lines[filter + 2].find(" 20.0 "), std::string::npos) << "0.1 m over 0.005 m";
}

// "+-" is the same half width everywhere, and the table says so. Mutation: the standard deviation, 0.071.
TEST(RunResult, PlusMinusIsTheIntervalOfTheMean) {
  const std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 4, 0.8)};
  const RunResult result = assemble("name", "none", drives);
  const auto lines = lines_of(result_table(result));
  EXPECT_EQ(lines.front(), kIntervalNote);
  EXPECT_NE(lines[line_of(lines, "filter ")].find("ATE rms [m] +- 95 %"), std::string::npos);
  const Summary& ate_m = result.filters.back().summary.ate_rms_m;
  EXPECT_NEAR(ate_m.half_width, 12.7062 * ate_m.sd / std::sqrt(2.0), 1e-4);
  EXPECT_NE(lines[line_of(lines, "ufastslam ")].find("0.15 +- 0.64"), std::string::npos);
}

// A detector that sees nothing is right in nothing of nothing. Mutation: "precision nan".
TEST(RunResult, WhatVisionCannotSayIsADash) {
  SeedDrive drive = drive_of(3, 4, 0.4);
  drive.recording.vision = VisionScore{.visible = 7};
  const std::string table = result_table(assemble("name", "none", std::vector{drive}));
  EXPECT_NE(table.find("vision: recall 0.0000, precision -, 0 misidentified, range rms - mm"),
            std::string::npos);
  EXPECT_EQ(table.find("nan"), std::string::npos);
}

// Mutations: the last seed's counters alone; the table in every run; a filter without any among its lines.
TEST(RunResult, WhatFiltersRepairAndRefuseIsCountedAndShown) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 4, 0.8)};
  EXPECT_EQ(result_table(assemble("name", "none", drives)).find("repaired"), std::string::npos);
  for (SeedDrive& drive : drives) drive.runs[1].last.counters = {9, 1, 2, 30, 4, 5, 7};
  const RunResult result = assemble("name", "none", drives);
  const auto json = run_json(result)["filters"];
  EXPECT_EQ(json["ufastslam"]["counters"].dump(),
            R"({"refused_by_particle":60,"rejected_inputs":8,"covariance_repairs":2,"weight_collapses":4,)"
            R"("joint_searches_cut":10,"refitted_by_particle":14})");
  EXPECT_EQ(json["dead_reckoning"]["counters"]["rejected_inputs"], 0);
  const auto lines = lines_of(result_table(result));
  const std::size_t header = line_of(lines, "repaired or refused");
  ASSERT_EQ(header + 3, lines.size()) << "a rule and one filter below it";
  EXPECT_TRUE(lines.back().starts_with("ufastslam "));
  EXPECT_NE(lines.back().find(" 60 "), std::string::npos);
}

// JSON knows neither NaN nor infinity. Mutation: writing 0 for them.
TEST(RunResult, WhatHasNoValueIsNull) {
  const auto json = run_json(assemble("name", "none", std::vector{drive_of(3, 4, 0.4)}));
  EXPECT_TRUE(json["vision"]["recall"].is_null());
  EXPECT_TRUE(json["filters"]["ufastslam"]["ate_rms_m"]["ci95_half_width"].is_null());  // of a single seed
  EXPECT_TRUE(json["filters"]["ufastslam"]["landmark_rms_m"]["mean"].is_null());        // there is none
}

// Mutations: the table in every run; counts of the last seed alone.
TEST(RunResult, AssociationIsScoredWhereTheTruthIsKnownAndShownWhereIdentitiesAreNot) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 4, 0.8)};
  EXPECT_TRUE(run_json(assemble("name", "none", drives))["filters"]["ufastslam"]["association"].is_null());
  for (SeedDrive& drive : drives) drive.runs[1].association = AssociationScore{10, 1, 2, 3, 4, 5};
  const RunResult known = assemble("name", "none", drives);
  EXPECT_EQ(run_json(known)["filters"]["ufastslam"]["association"].dump(),
            R"({"correct":20,"wrong":2,"missed":4,"imagined":6,"duplicated":8,"spurious":10})");
  EXPECT_EQ(result_table(known).find("duplicated"), std::string::npos);
  drives[1].recording.log.steps[2].measurements.emplace_back();
  EXPECT_NE(result_table(assemble("name", "none", drives)).find("duplicated"), std::string::npos);
}

// Mutation: a cell too few where the truth is not known.
TEST(RunResult, StepsHaveALineForEachSeedFilterAndStepOfAsManyCells) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  drives[1].recording.log.steps[2].truth.reset();
  drives[1].runs[1].poses.resize(1);  // failed at the second step
  drives[1].runs[1].covariances.resize(1);
  drives[1].runs[1].failed = true;
  std::istringstream csv(steps_csv(drives));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line); ++lines)
    EXPECT_EQ(std::ranges::count(line, ','), 18) << line;
  EXPECT_EQ(lines, 1U + 4U + 4U + 6U + 1U);
}

// Mutation: keeping the last seed's alone.
TEST(RunResult, TimingIsSummedOverTheSeeds) {
  std::vector<SeedDrive> drives = {drive_of(3, 1, 0.4), drive_of(8, 1, 0.8)};
  for (SeedDrive& drive : drives) drive.recording.timing = {{"render", 1.5}};
  RunTally tally("name", "none");
  for (const SeedDrive& drive : drives) tally.add(score_seed(drive, {}));
  EXPECT_EQ(timing_json(tally.timing(), drives.size())["seconds"]["render"], 3.0);
}

TEST(RunResult, RefusesDrivesThatCannotBePutTogether) {
  EXPECT_THROW(assemble("name", "none", {}), std::invalid_argument);
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  drives[1].runs.pop_back();
  EXPECT_THROW(assemble("name", "none", drives), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
