#include "harness/run/seed_result.h"

#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <malloc.h>

#include "harness/json/cbor.h"
#include "harness/run/run_output.h"
#include "harness/scoring/replay.h"
#include "slam/math/random.h"
#include "slam/models/motion.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using Limits = std::numeric_limits<double>;

/// The bits of a number, so that -0 is not 0; all NaN are one.
std::uint64_t bits(double value) {
  return std::isnan(value) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value);
}

SeedResult result_at(double value) {
  SeedResult result{.seed = ~std::uint64_t{0}, .bound_m2 = {-value}, .csv = "1,2\n", .time_s = {value}};
  ScoredRun run{.filter = "ufastslam", .particles = 7, .errors_m = {value, -value}};
  run.score.trajectory.ate_rms_m = value;
  run.score.normalised_errors = {std::nullopt, SquaredSum{value, 3}};
  run.score.consistency.innovations.by_landmark[4] = {{value, 2}, {-value, 2}};
  result.runs = {run};
  for (int byte = 0; byte < 256; ++byte) result.detections_gz += static_cast<char>(byte);
  result.map.emplace().estimates = {{"ekf", {{value, -value, 0.0}}, {{3, 5, {value, 1.0}}}}};
  result.map->estimates[0].landmarks[0].covariance(0, 1) = value;
  return result;
}

void expect_carried(double value) {
  const SeedResult back = seed_result_from_bytes(to_bytes(result_at(value)));
  const ScoredRun& run = back.runs.at(0);
  EXPECT_EQ(bits(run.errors_m.at(1)), bits(-value)) << value;
  EXPECT_EQ(back.detections_gz, result_at(value).detections_gz);
  EXPECT_EQ(bits(run.score.trajectory.ate_rms_m), bits(value)) << value;
  EXPECT_FALSE(run.score.normalised_errors.at(0));
  EXPECT_EQ(bits(run.score.normalised_errors.at(1).value().sum), bits(value)) << value;
  EXPECT_EQ(bits(run.score.consistency.innovations.by_landmark.at(4).used.sum), bits(-value)) << value;
  EXPECT_EQ(bits(back.bound_m2.at(0)), bits(-value)) << value;
  EXPECT_EQ(bits(back.time_s.at(0)), bits(value)) << value;
  const MapEstimate& estimate = back.map.value().estimates.at(0);
  EXPECT_EQ(bits(estimate.path.at(0).y_m), bits(-value)) << value;
  EXPECT_EQ(bits(estimate.landmarks.at(0).covariance(0, 1)), bits(value)) << value;
  EXPECT_EQ(estimate.landmarks.at(0).covariance(1, 0), 0.0);
}

// Law: every number comes back with the bits it had.
// Mutations: matrices in single precision, or transposed.
TEST(SeedResultBytes, CarryEveryNumberToTheLastBit) {
  for (const double value : {0.0, -0.0, 0.1, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             Limits::max(), Limits::min(), Limits::denorm_min(), Limits::epsilon()})
    expect_carried(value);
  slam::RandomStream random(2, slam::Stream::kWorld);
  for (int i = 0; i < 200; ++i) expect_carried(std::ldexp(random.normal(), i - 100));
}

// Mutation: leaving out whether a run failed.
TEST(SeedResultBytes, CarryWhatASeedIs) {
  SeedResult result = result_at(1.0);
  result.runs[0].score.failed = true;
  result.runs[0].association = AssociationScore{.missed = 6};
  result.runs[0].counters.resamplings = 11;
  result.bound = BoundScores{.smoothing = {.pose_rms_m = 0.25}};
  result.vision.emplace().repeated = 3;
  result.snapshots = {{12, std::string("\x89PNG\0\xff", 6)}};
  result.pairs = {{8, 41, {3, 0.1}, std::string("\xff\xd8\0", 3), "right"}};
  result.start_is_true = false;
  const SeedResult back = seed_result_from_bytes(to_bytes(result));
  EXPECT_EQ(back.seed, ~std::uint64_t{0});
  EXPECT_EQ(back.runs.at(0).filter, "ufastslam");
  EXPECT_EQ(back.runs[0].particles, 7);
  EXPECT_TRUE(back.runs[0].score.failed);
  EXPECT_EQ(back.runs[0].association.value().missed, 6);
  EXPECT_EQ(back.runs[0].counters.resamplings, 11);
  EXPECT_EQ(back.bound.value().smoothing.pose_rms_m, 0.25);
  EXPECT_EQ(back.vision.value().repeated, 3);
  EXPECT_EQ(back.snapshots.at(0).png, result.snapshots[0].png);
  const KeptPair& pair = back.pairs.at(0);
  EXPECT_EQ(std::tuple(pair.seed, pair.frame, pair.badness.faults, pair.badness.worst_nis),
            std::tuple(8, 41, 3, 0.1));
  EXPECT_EQ(pair.left_jpeg, result.pairs[0].left_jpeg);
  EXPECT_EQ(pair.right_jpeg, "right");
  EXPECT_FALSE(back.start_is_true);
  EXPECT_TRUE(back.identities_known);
  EXPECT_EQ(back.csv, "1,2\n");
  EXPECT_FALSE(seed_result_from_bytes(to_bytes(SeedResult{})).map);
}

/// A score's numbers by name, but for the poses that bring it into the truth's frame.
nlohmann::json numbers_of(const FilterScore& score) {
  nlohmann::json all = json_of(to_bytes({.runs = {{.score = score}}})).at("runs").at(0).at("score");
  all.erase("truth_from_estimate");
  all.at("trajectory").erase("truth_from_estimate");
  return all.flatten();
}

// Law: where the truth does not say where the filters started, no score depends on the frame that they made.
// Mutation: a metric left out of leave_out_what_is_not_aligned (score.cpp), any of them.
TEST(SeedResult, NoScoreDependsOnAFrameOfTheFiltersOwn) {
  MeasurementLog log;
  log.start_is_true = false;
  for (int i = 0; i < 3; ++i) log.landmarks.push_back({i, slam::kUnknown, {2.0 * i, 3.0 - i}});
  FilterRun run;
  for (int i = 0; i < 30; ++i) {
    LogStep step;
    step.truth = slam::Pose{0.2 * i, 0.1 * i * i, 0.03 * i};
    run.poses.push_back({0.2 * i + 0.1 * (i % 3), 0.1 * i * i, 0.03 * i + 0.01 * (i % 2)});
    run.covariances.push_back(Eigen::Matrix3d::Identity());
    if (i % 2 == 0) step.measurements.push_back({});
    log.steps.push_back(step);
  }
  for (const LandmarkTruth& landmark : log.landmarks)
    run.last.landmarks.push_back(
        {landmark.landmark_id, slam::kUnknown, 1.1 * landmark.position_m, Eigen::Matrix2d::Identity()});
  const slam::Pose elsewhere{4.0, -7.0, 2.0};
  FilterRun moved = run;
  for (slam::Pose& pose : moved.poses) pose = slam::compose(elsewhere, pose);
  for (slam::LandmarkEstimate& landmark : moved.last.landmarks)
    landmark = moved_landmark(elsewhere, landmark);
  const nlohmann::json here = numbers_of(score(run, log)), there = numbers_of(score(moved, log));
  for (const auto& [key, value] : here.items()) {
    if (!value.is_number_float()) {
      EXPECT_EQ(value, there.at(key)) << key;
    } else if (const double number = value; std::isnan(number)) {
      EXPECT_TRUE(std::isnan(there.at(key).get<double>())) << key;
    } else {
      EXPECT_NEAR(number, there.at(key).get<double>(), 1e-9) << key;
    }
  }
}

// Law: each number of a path's score is in run.json under its own name. Mutations: a row of kMetrics
// (score.cpp) or a key (run_result.cpp) with another's number; a number without a key.
TEST(SeedResult, HasEachNumberOfAPathsScoreUnderItsName) {
  nlohmann::json bytes = json_of(to_bytes({.runs = {{.filter = "ekf"}}}));
  nlohmann::json& path = bytes["runs"][0]["score"]["trajectory"];
  double value = 1.0;
  for (nlohmann::json& number : path)
    if (number.is_number_float()) number = value += 0.125;
  RunTally tally("name", kNoBackend);
  tally.add(seed_result_from_bytes(bytes_of(bytes)));
  const nlohmann::ordered_json all = run_json(tally.result());
  const nlohmann::ordered_json& told = all["filters"]["ekf"];
  const std::set<std::string> kept_back = {"ate_aligned_max_m", "rpe_heading_rms_rad"};
  for (const auto& [key, number] : path.items()) {
    if (!number.is_number_float() || kept_back.contains(key)) continue;
    ASSERT_TRUE(told.contains(key)) << key;
    EXPECT_EQ(told[key]["mean"].get<double>(), number.get<double>()) << key;
  }
}

/// A seed of so many steps with two filters, as a run that writes everything gets it.
SeedResult seed_of(std::uint64_t seed, std::size_t steps) {
  SeedResult result{.seed = seed, .csv = std::string(200 * steps, 'x')};
  result.bound_m2.assign(steps, 0.1);
  result.time_s.assign(steps, 1.0);
  for (const char* filter : {"ekf", "ufastslam"}) {
    result.runs.push_back({.filter = filter});
    result.runs.back().errors_m.assign(steps, 0.1);
    result.runs.back().score.normalised_errors.assign(steps, SquaredSum{3.0, 3});
    for (int landmark = 0; landmark < 100; ++landmark)
      result.runs.back().score.consistency.innovations.by_landmark[landmark] = {{2.0, 2}, {2.0, 2}};
  }
  return result;
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

// Law: what is kept of a seed does not depend on how long it drove. In 512 seeds of 2,000 steps there are 200
// MB of lines and 80 MB of errors. Mutations: a tally or a picture that keeps the seeds that it was given.
TEST(RunOutput, KeepsSomeNumbersOfASeedAndNoneOfItsSteps) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator does not say what is in use";
#endif
  const TestFolder folder;
  RunOutput output(folder.path(), RunTally("name", kNoBackend));
  output.add(seed_of(0, 2000));
  const std::size_t before = bytes_in_use();
  constexpr std::uint64_t kSeeds = 512;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) output.add(seed_of(seed, 2000));
  const auto kept = static_cast<double>(bytes_in_use()) - static_cast<double>(before);
  EXPECT_LT(kept / static_cast<double>(kSeeds), 4096.0);
}

// Law: what the map shows of each step does not depend on the frame that the filters made, either: positions
// and their covariances are turned into the truth's. Mutations: covariances not turned, or turned back; the
// sightings seen from the estimate.
TEST(SeedResult, TheMapOfEachStepIsInTheFrameOfTheTruth) {
  SeedDrive drive;
  MeasurementLog& log = drive.recording.log;
  FilterRun run{.filter = "ekf"};
  for (int i = 0; i < 20; ++i) {
    const slam::Pose truth{0.2 * i, 0.05 * i * i, 0.1 * i};
    log.steps.push_back({.truth = truth});
    log.steps.back().measurements.push_back({.range_m = 2.0, .bearing_rad = 0.25});
    run.poses.push_back({truth.x_m + 0.01 * (i % 3), truth.y_m, truth.heading_rad});
    run.covariances.push_back(Eigen::Vector3d(0.01 * (1 + i), 0.04, 0.001).asDiagonal());
  }
  drive.runs = {run};
  drive.references.batch.failed = true;
  const SeedResult stays = score_seed(drive, {.map = true});
  log.start_is_true = false;
  const slam::Pose elsewhere{4.0, -7.0, 2.0};
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2.0).toRotationMatrix();
  for (std::size_t i = 0; i < 20; ++i) {
    drive.runs[0].poses[i] = slam::compose(elsewhere, run.poses[i]);
    const Eigen::Matrix2d position = run.covariances[i].topLeftCorner<2, 2>();
    drive.runs[0].covariances[i].topLeftCorner<2, 2>() = turn * position * turn.transpose();
  }
  const SeedResult moved = score_seed(drive, {.map = true});
  // The best alignment also takes out the mean error of a filter that starts at the truth.
  for (std::size_t k = 0; k < 20; ++k) {
    const auto at = [&](const SeedResult& seed) { return seed.track.value().covariances.at(0).at(k); };
    EXPECT_LT((at(moved) - at(stays)).norm(), 0.02 * at(stays).norm()) << k;
    const LogStep& step = log.steps[k];
    const Eigen::Vector2d seen =
        moved.track->seen_m.at(k).at(0) - Eigen::Vector2d(step.truth->x_m, step.truth->y_m);
    EXPECT_NEAR(seen.norm(), 2.0, 1e-12);
    EXPECT_NEAR(std::remainder(std::atan2(seen.y(), seen.x()) - step.truth->heading_rad - 0.25, 2.0 * M_PI),
                0.0, 1e-12);
  }
}

}  // namespace
}  // namespace stereobench::harness
