/// `stereobench calibrate`: a detector's noise, measured, written, and told to filters.
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

std::vector<std::string> calibration(const TestFolder& scratch, const std::string& out,
                                     const std::vector<std::string>& more = {},
                                     const std::string& seeds = "0..3") {
  std::vector<std::string> arguments = {
      "calibrate", scenario_path("ball_circle"),
      "--set",     "rig={width_px: 512, height_px: 384, focal_px: 443.5, baseline_m: 0.12, height_m: 0.3}",
      "--seeds",   seeds,
      "--out",     (scratch.path() / out).string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

nlohmann::json json_in(const TestFolder& scratch, const std::string& file) {
  return nlohmann::json::parse(bytes_of(scratch.path() / file));
}

// Mutations: seeds of the fit among those held out; noise drawn by the number of the process.
TEST(CalibrateCommand, GivesTheSameBytesForAnyNumberOfJobs) {
  const TestFolder scratch;
  const Outcome one = run_stereobench(calibration(scratch, "one", {"--jobs", "1"}));
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("NIS/2 stated"));
  ASSERT_EQ(run_stereobench(calibration(scratch, "two", {"--jobs", "2"})).exit_code, 0);
  for (const char* file : {"calibration.json", "noise.yaml"})
    EXPECT_EQ(bytes_of(scratch.path() / "one" / file), bytes_of(scratch.path() / "two" / file)) << file;
  const nlohmann::json result = json_in(scratch, "one/calibration.json");
  EXPECT_EQ(result["fitted_seeds"], nlohmann::json({0, 2}));
  EXPECT_EQ(result["held_out_seeds"], nlohmann::json({1, 3}));
  EXPECT_GT(result["recall"], 0.95);
  EXPECT_GT(result["bins"][2]["samples"], 5);
}

// A file is worth what its lines are worth in the scenario itself, and not what sightings state.
// Mutation: a file that is read and not told to the filters.
TEST(CalibrateCommand, WritesNoiseThatRunsBelieve) {
  const TestFolder scratch;
  ASSERT_EQ(run_stereobench(calibration(scratch, "noise", {"--law", "stereo"})).exit_code, 0);
  const std::string noise = (scratch.path() / "noise/noise.yaml").string();
  const auto filters_with = [&](const std::string& believed) {
    const Outcome outcome = run_stereobench({"run", scenario_path("ball_circle"), "--set", "path.laps=0.1",
                                             "--set", "gates=[]", "--seeds", "0", "--filters", "ekf", "--set",
                                             "believed_measurement_noise=" + believed, "--out",
                                             (scratch.path() / "run").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json_in(scratch, "run/run.json")["filters"]["ekf"];
  };
  std::ifstream file(noise);
  std::string lines;
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with("#")) lines += (lines.empty() ? "" : ", ") + line;
  EXPECT_THAT(lines, HasSubstr("kind: stereo, range_sd_m: "));
  const nlohmann::json told = filters_with("{kind: file, file: " + noise + "}");
  EXPECT_EQ(told, filters_with("{" + lines + "}"));
  EXPECT_NE(told, filters_with("{kind: per_observation}"));
}

TEST(CalibrateCommand, RefusesWhatItCannotCalibrate) {
  const TestFolder scratch;
  const Outcome oracle = run_stereobench({"calibrate", scenario_path("open_field")});
  EXPECT_EQ(oracle.exit_code, 2);
  EXPECT_THAT(oracle.err, HasSubstr("the oracle has no pictures"));
  const Outcome one_seed = run_stereobench(calibration(scratch, "out", {}, "1"));
  EXPECT_EQ(one_seed.exit_code, 2);
  EXPECT_THAT(one_seed.err, HasSubstr("expected at least two"));
  const Outcome no_file = run_stereobench({"run", scenario_path("ball_circle"), "--set",
                                           "believed_measurement_noise={kind: file, file: nowhere.yaml}"});
  EXPECT_EQ(no_file.exit_code, 2);
  EXPECT_THAT(no_file.err, HasSubstr("believed_measurement_noise.file: expected a file that"));
}

}  // namespace
}  // namespace stereobench::harness
