#include "harness/run/consistency_report.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/harness/run/assemble.h"

namespace stereobench::harness {
namespace {

/// A drive of six steps beside a landmark; its filter sees it from the second step on, and refuses it once.
SeedDrive drive_of(std::uint64_t seed) {
  SeedDrive drive{.seed = seed};
  drive.references.batch.filter = "batch";
  MeasurementLog& log = drive.recording.log;
  log.landmarks = {{4, slam::kUnknown, {3.0, 1.0}}};
  FilterRun run{.filter = "fastslam2", .particles = 20, .seed = seed};
  for (int k = 0; k < 6; ++k) {
    log.steps.push_back({.stamp_ns = 100 * k, .truth = slam::Pose{1.0 * k, 0.0, 0.0}});
    run.poses.push_back({1.0 * k, 1.5, 0.0});
    run.covariances.push_back(Eigen::Matrix3d::Identity());
    run.updates.push_back({});
    if (k == 0) continue;
    log.steps.back().measurements.push_back({.range_m = 1.0, .landmark_id = 4});
    run.updates.back() = {{{0, 2.0 * k, k == 5}}, 10.0 + k, 3 * k};
  }
  run.last.landmarks = {{4, slam::kUnknown, {3.0, 1.1}, Eigen::Matrix2d::Identity()}};
  run.last.counters.resamplings = 2;
  drive.runs = {run};
  drive.references.batch.poses = run.poses;
  drive.references.batch.covariances.assign(6, Eigen::Matrix3d::Zero());
  return drive;
}

nlohmann::ordered_json consistency_of(const std::vector<SeedDrive>& drives) {
  return run_json(assemble("name", "none", drives))["filters"]["fastslam2"]["consistency"];
}

TEST(ConsistencyReport, JsonHasWhatTheRunsSaid) {
  const auto json = consistency_of({drive_of(3), drive_of(8)});
  EXPECT_EQ(json["nis"]["sightings"], 10);
  EXPECT_EQ(json["nis"]["refused"], 2);
  EXPECT_DOUBLE_EQ(json["nis"]["per_run"]["mean"], 3.0);
  EXPECT_DOUBLE_EQ(json["nis"]["per_run_without_refused"]["mean"], 2.5);
  ASSERT_EQ(json["nis"]["runs"].size(), 2U);
  const auto& run = json["nis"]["runs"][1];
  EXPECT_EQ(run["seed"], 8);
  EXPECT_NEAR(run["band99_low"], 2.15586 / 10.0, 1e-6);
  EXPECT_NEAR(run["band99_high"], 25.1882 / 10.0, 1e-5);
  EXPECT_LT(run["p"], 0.01);  // outside of its band
  EXPECT_EQ(json["nis"]["landmarks"]["worst"]["landmark_id"], 4);
  EXPECT_EQ(json["nees"]["steps"], 4);
  EXPECT_EQ(json["nees"]["fraction_outside_band95"], 0.0);
  EXPECT_TRUE(json["nees"]["first_step_outside"].is_null());
  EXPECT_DOUBLE_EQ(json["path_coverage"]["within_50"]["mean"], 0.0);
  EXPECT_DOUBLE_EQ(json["path_coverage"]["within_95"]["mean"], 1.0);
  EXPECT_DOUBLE_EQ(json["effective_particles"]["mean"], 13.0);
  EXPECT_DOUBLE_EQ(json["least_effective_particles"]["mean"], 11.0);
  EXPECT_DOUBLE_EQ(json["resamplings"]["mean"], 2.0);
  EXPECT_DOUBLE_EQ(json["ancestors_of_first_update"]["mean"], 3.0);
  EXPECT_DOUBLE_EQ(json["ancestors_of_last_quarter"]["mean"], 12.0);
}

// Gates name keys before there is a result. Mutation: leaving keys out where nothing is known.
TEST(ConsistencyReport, OfNothingHasTheSameKeys) {
  RunResult nothing;
  nothing.filters = {{.filter = "ekf"}};
  const auto json = consistency_json(nothing.filters[0]);
  const auto full = consistency_of({drive_of(3)});
  ASSERT_EQ(json.size(), full.size());
  for (const auto& [key, value] : full.items())
    for (const auto& [inner, ignored] : value.items()) EXPECT_TRUE(json.at(key).contains(inner)) << inner;
}

TEST(ConsistencyReport, FailedRunsHaveNone) {
  SeedDrive failed = drive_of(8);
  failed.runs[0].failed = true;
  EXPECT_EQ(consistency_of({drive_of(3), failed})["nis"]["runs"].size(), 1U);
}

// Mutations: the mean of lengths, not halved; cells where nothing was seen.
TEST(ConsistencyReport, StepsHaveTheirInnovations) {
  const std::vector<SeedDrive> drives = {drive_of(3)};
  std::istringstream csv(steps_csv(drives));
  std::vector<std::string> ends;
  for (std::string line; std::getline(csv, line);) {
    std::size_t cells = line.size();
    for (int i = 0; i < 6; ++i) cells = line.rfind(',', cells - 1);
    ends.push_back(line.substr(cells));
  }
  EXPECT_EQ(ends.at(0), ",error_rank,expected,refused,nis,effective_particles,ancestors");
  EXPECT_EQ(ends.at(1), ",,,,,,");
  EXPECT_EQ(ends.at(3), ",3,1,0,2,12,6");
  EXPECT_EQ(ends.at(6), ",3,1,1,5,15,15");
}

TEST(ConsistencyReport, TheTableHasALineAFilter) {
  const std::string table = consistency_table(assemble("name", "none", std::vector{drive_of(3)}));
  EXPECT_EQ(std::ranges::count(table, '\n'), 3);
  EXPECT_NE(table.find("0.00 / 1.00 / 1.00"), std::string::npos);
}

}  // namespace
}  // namespace stereobench::harness
