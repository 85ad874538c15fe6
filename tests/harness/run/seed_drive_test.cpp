#include "harness/run/seed_drive.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "harness/run/seed_result.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

/// A short drive through three balls that each seed moves a little, sensed without pixels.
Experiment short_drive() {
  Experiment experiment{.scenario = {.name = "short"}, .particles = 5};
  worlds::Scenario& scenario = experiment.scenario;
  scenario.world.balls = {{{2.0, 1.0, 0.3}, 0.1, 0}, {{3.0, -1.0, 0.3}, 0.1, 1}, {{4.0, 0.5, 0.3}, 0.1, 2}};
  scenario.placement_jitter_m = 0.1;
  scenario.sensor = worlds::SensorKind::kOracle;
  scenario.odometry_noise = {.v_constant_mps = 0.05, .w_constant_radps = 0.05};
  slam::Pose pose{0.5, 0.0, 0.1};
  for (int k = 0; k < 30; ++k) {
    worlds::PathStep step{.stamp_ns = k * 500'000'000LL, .pose = pose};
    if (k > 0) step.controls = {{0.2, 0.05, 0.5}};
    for (const slam::Control& control : step.controls) step.pose = pose = slam::advance(pose, control);
    scenario.path.push_back(step);
  }
  return experiment;
}

constexpr SeedParts kAll = {.steps = true, .map = true};

/// All that a seed gave but the time it took.
std::string bytes_without_timing(SeedResult result) {
  result.timing.clear();
  return to_bytes(result);
}

std::string bytes_without_timing(const SeedDrive& drive) {
  return bytes_without_timing(score_seed(drive, kAll));
}

std::vector<SeedResult> results_of(const std::vector<DriveTask>& tasks, int jobs) {
  std::vector<SeedResult> results;
  drive_seeds(tasks, jobs, "test", [&](std::size_t index, const SeedResult& result) {
    EXPECT_EQ(index, results.size());
    results.push_back(result);
  });
  return results;
}

double largest_odometry_error_mps(const Experiment& experiment) {
  const worlds::Scenario& scenario = experiment.scenario;
  const MeasurementLog log = record(experiment, 3, {}).log;
  double largest = 0.0;
  for (std::size_t k = 0; k < log.steps.size(); ++k)
    for (std::size_t i = 0; i < log.steps[k].odometry.size(); ++i)
      largest =
          std::max(largest, std::abs(log.steps[k].odometry[i].v_mps - scenario.path[k].controls[i].v_mps));
  return largest;
}

// Mutation: true odometry in place of the measured one.
TEST(Record, OdometryIsMeasuredAndTruthIsNot) {
  Experiment experiment = short_drive();
  worlds::Scenario& scenario = experiment.scenario;
  EXPECT_GT(largest_odometry_error_mps(experiment), 0.02);
  scenario.odometry_noise = {};
  EXPECT_EQ(largest_odometry_error_mps(experiment), 0.0);
  const MeasurementLog log = record(short_drive(), 3, {}).log;
  ASSERT_EQ(log.steps.size(), scenario.path.size());
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    ASSERT_TRUE(log.steps[k].truth);
    EXPECT_EQ(log.steps[k].truth->x_m, scenario.path[k].pose.x_m);
    EXPECT_EQ(log.steps[k].stamp_ns, scenario.path[k].stamp_ns);
    EXPECT_EQ(log.steps[k].odometry.size(), scenario.path[k].controls.size());
  }
}

// What is varied in a sweep must not move the world or the odometry of a seed.
TEST(Record, WorldAndOdometryOfASeedDoNotDependOnTheSensor) {
  Experiment noisy = short_drive();
  noisy.scenario.oracle.range_sd_m *= 3.0;
  const MeasurementLog log = record(short_drive(), 3, {}).log;
  const MeasurementLog other = record(noisy, 3, {}).log;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(log.landmarks[i].position_m, other.landmarks[i].position_m);
  for (std::size_t k = 1; k < log.steps.size(); ++k)
    EXPECT_EQ(log.steps[k].odometry[0].v_mps, other.steps[k].odometry[0].v_mps);
  EXPECT_NE(log.steps[0].measurements.at(0).range_m, other.steps[0].measurements.at(0).range_m);
}

// Over 400 seeds, the errors of the odometry and of the sensor spread as told and have nothing to do with
// each other: the sum of 400 products of independent unit normals has a standard deviation of 20, and of 400
// squares of 28.
TEST(Record, OdometryAndSensorErrAnewWithEachSeedAndEachOnItsOwn) {
  const Experiment experiment = short_drive();
  const worlds::Scenario& scenario = experiment.scenario;
  double squares = 0.0;
  double products = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const MeasurementLog log = record(experiment, seed, {}).log;
    const slam::RangeBearing& sighting = log.steps[0].measurements.at(0);
    const Eigen::Vector2d place_m =
        log.landmarks[static_cast<std::size_t>(sighting.landmark_id)].position_m - Eigen::Vector2d(0.5, 0.0);
    const double sensor = (sighting.range_m - place_m.norm()) / scenario.oracle.range_sd_m;
    const double odometry = (log.steps[1].odometry[0].v_mps - 0.2) / scenario.odometry_noise.v_constant_mps;
    squares += odometry * odometry;
    products += odometry * sensor;
  }
  EXPECT_NEAR(squares, 400.0, 5.0 * 28.3);
  EXPECT_LT(std::abs(products), 5.0 * 20.0);
}

TEST(Record, ProgressGrowsToOne) {
  double last = 0.0;
  record(short_drive(), 3, {.on_progress = [&](double done) {
           EXPECT_GT(done, last);
           last = done;
         }});
  EXPECT_EQ(last, 1.0);
}

// The bound is that of the odometry's real noise, whatever the filters believe; the batch believes what they
// do. Mutation: either one told the other's.
TEST(DriveSeed, TheBoundKnowsTheNoiseAndTheBatchBelievesIt) {
  const Experiment consistent = short_drive();
  Experiment deceived = consistent;
  deceived.believed.odometry_noise = consistent.scenario.odometry_noise;
  deceived.believed.odometry_noise->v_constant_mps *= 5.0;
  const References one = drive_seed({&consistent, 3}, [](double) {}).references;
  const References two = drive_seed({&deceived, 3}, [](double) {}).references;
  ASSERT_EQ(one.bound.value().poses.size(), consistent.scenario.path.size());
  EXPECT_EQ(one.bound->landmarks.size(), 3U);
  EXPECT_EQ(one.bound->poses.back(), two.bound.value().poses.back());
  EXPECT_EQ(one.batch.poses.size(), consistent.scenario.path.size());
  EXPECT_NE(one.batch.poses.back().x_m, two.batch.poses.back().x_m);
  EXPECT_FALSE(one.batch.failed);
}

// Mutation: an experiment's law that the filters are not told.
TEST(DriveSeed, TellsTheFiltersWhatToBelieveOfTheSensor) {
  Experiment experiment = short_drive();
  const worlds::OracleSensor& oracle = experiment.scenario.oracle;
  const SeedDrive stated = drive_seed({&experiment, 3}, [](double) {});
  experiment.believed.measurement_noise = {.range_sd_m = oracle.range_sd_m,
                                           .bearing_sd_rad = oracle.bearing_sd_rad};
  const SeedDrive same = drive_seed({&experiment, 3}, [](double) {});
  EXPECT_EQ(bytes_without_timing(stated), bytes_without_timing(same));
  experiment.believed.measurement_noise->range_sd_per_m2 = 0.1;
  const SeedDrive other = drive_seed({&experiment, 3}, [](double) {});
  EXPECT_NE(stated.runs.back().poses.back().x_m, other.runs.back().poses.back().x_m);
}

// Mutations: filters seeded by the worker's process, or all alike.
TEST(DriveSeeds, GivesTheSameBytesForAnyNumberOfJobs) {
  const Experiment experiment = short_drive();
  std::vector<DriveTask> tasks;
  for (const std::uint64_t seed : {4U, 2U, 9U, 0U}) tasks.push_back({&experiment, seed, kAll});
  const auto one = results_of(tasks, 1);
  ASSERT_EQ(one.size(), tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i)
    EXPECT_EQ(bytes_without_timing(one[i]), bytes_without_timing(drive_seed(tasks[i], [](double) {})));
  const auto three = results_of(tasks, 3);
  for (std::size_t i = 0; i < tasks.size(); ++i)
    EXPECT_EQ(bytes_without_timing(one[i]), bytes_without_timing(three[i])) << "seed " << tasks[i].seed;
}

// Cells of a sweep differ in what is varied alone: here in pixel noise, which the oracle does not have.
// Mutation: filter seeds that depend on the cell.
TEST(DriveSeeds, CellsOfASweepShareTheirSeeds) {
  const Experiment cell = short_drive();
  Experiment other = cell;
  other.scenario.camera.noise_sd_levels = 4.0;
  const std::vector<DriveTask> tasks = {
      {&cell, 1, kAll}, {&cell, 2, kAll}, {&other, 1, kAll}, {&other, 2, kAll}};
  const auto drives = results_of(tasks, 2);
  ASSERT_EQ(drives.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(bytes_without_timing(drives[i]), bytes_without_timing(drives[i + 2]));
  EXPECT_NE(bytes_without_timing(drives[0]), bytes_without_timing(drives[1]));
}

// Filters begin where they are told, each seed elsewhere; the bound begins at the truth, whatever is
// believed. Mutations seen to turn this red: the start as it is; one start for all seeds; the bound of what
// is believed.
TEST(DriveSeed, TellsFiltersAStartThatIsOff) {
  Experiment experiment = short_drive();
  experiment.filters = {"dead_reckoning"};
  const SeedDrive exact = drive_seed({.experiment = &experiment, .seed = 1}, [](double) {});
  experiment.scenario.start_noise = {0.5, 0.2};
  const SeedDrive off = drive_seed({.experiment = &experiment, .seed = 1}, [](double) {});
  const SeedDrive again = drive_seed({.experiment = &experiment, .seed = 1}, [](double) {});
  const SeedDrive other = drive_seed({.experiment = &experiment, .seed = 2}, [](double) {});
  EXPECT_EQ(exact.recording.log.start.x_m, experiment.scenario.path.front().pose.x_m);
  EXPECT_NE(off.recording.log.start.x_m, exact.recording.log.start.x_m);
  EXPECT_NE(off.recording.log.start.heading_rad, exact.recording.log.start.heading_rad);
  EXPECT_EQ(off.recording.log.start.x_m, again.recording.log.start.x_m);
  EXPECT_NE(off.recording.log.start.x_m, other.recording.log.start.x_m);
  EXPECT_GT(off.runs.front().covariances.front()(0, 0), 0.24);
  ASSERT_TRUE(off.references.bound);
  EXPECT_GT(off.references.bound->poses.front()(0, 0), 0.24);
  experiment.believed.start_noise = worlds::StartNoise{};
  const SeedDrive unaware = drive_seed({.experiment = &experiment, .seed = 1}, [](double) {});
  EXPECT_EQ(unaware.references.bound->poses.back(), off.references.bound->poses.back());
  EXPECT_LT(unaware.runs.front().covariances.front()(0, 0), 0.01);
}

}  // namespace
}  // namespace stereobench::harness
