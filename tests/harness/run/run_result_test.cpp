#include "harness/run/run_result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

/// A drive along x of some steps; dead reckoning is `slip_m` beside it, the other filter a quarter of that,
/// the batch an eighth. The bound has a position rms of 0.01 m.
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
                                                  "vision", "bound", "batch", "filters", "comparisons"}));
  EXPECT_EQ(keys_of(json["renderer"]), std::set<std::string>{"backend"});
  for (SeedDrive& drive : drives) drive.recording.timing["render"] = 123.0;
  EXPECT_EQ(run_json(assemble("name", "none", drives)), json);
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

// Mutations: the batch's error among the filters; a bound's heading for its position; the ratio upside down.
TEST(RunResult, FiltersAreHeldAgainstTheBoundAndTheBatch) {
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  const auto json = run_json(assemble("name", "none", drives));
  EXPECT_DOUBLE_EQ(json["bound"]["pose_rms_m"]["mean"], 0.01);
  EXPECT_DOUBLE_EQ(json["bound"]["heading_rms_rad"]["max"], 0.2);
  EXPECT_DOUBLE_EQ(json["batch"]["ate_rms_m"]["mean"], 0.075);
  EXPECT_EQ(json["batch"]["failures"], 0);
  EXPECT_FALSE(json["filters"].contains("batch"));
  EXPECT_NEAR(json["filters"]["ufastslam"]["efficiency"], 0.25 * std::sqrt((0.16 + 0.64) / 2.0) / 0.01, 1e-9);
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

TEST(RunResult, TheTableEndsWithTheBatchAndTheBound) {
  const std::string table = result_table(assemble("name", "none", std::vector{drive_of(3, 4, 0.4)}));
  const std::size_t batch = table.find("\nbatch ");
  const std::size_t bound = table.find("\nbound ");
  EXPECT_NE(batch, std::string::npos);
  EXPECT_NE(bound, std::string::npos);
  EXPECT_LT(table.find("\nufastslam "), batch);
  EXPECT_LT(batch, bound);
  EXPECT_NE(table.find("0.01", bound), std::string::npos);
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
  std::istringstream csv(steps_csv(assemble("name", "none", drives), drives));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line); ++lines)
    EXPECT_EQ(std::ranges::count(line, ','), 18) << line;
  EXPECT_EQ(lines, 1U + 4U + 4U + 6U + 1U);
}

// Mutation: keeping the last seed's alone.
TEST(RunResult, TimingIsSummedOverTheSeeds) {
  std::vector<SeedDrive> drives = {drive_of(3, 1, 0.4), drive_of(8, 1, 0.8)};
  for (SeedDrive& drive : drives) drive.recording.timing = {{"render", 1.5}};
  EXPECT_EQ(timing_json(drives)["seconds"]["render"], 3.0);
}

TEST(RunResult, RefusesDrivesThatCannotBePutTogether) {
  EXPECT_THROW(assemble("name", "none", {}), std::invalid_argument);
  std::vector<SeedDrive> drives = {drive_of(3, 4, 0.4), drive_of(8, 6, 0.8)};
  drives[1].runs.pop_back();
  EXPECT_THROW(assemble("name", "none", drives), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
