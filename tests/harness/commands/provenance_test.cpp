/// What run.json says of what it was made from.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "harness/io/sha256.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

nlohmann::json run(const std::filesystem::path& out, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), {"--out", out.string()});
  const Outcome outcome = run_stereobench(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(out / "run.json"));
}

// Law: the resolved scenario makes the same result, and the hash is that of the file that lies beside.
// Mutations: the scenario's text without overrides, or without the command line's seeds, particles and
// filters.
TEST(MadeFrom, IsWhatMakesTheSameAgain) {
  const TestFolder scratch;
  const auto first = scratch.path() / "first", second = scratch.path() / "second";
  auto made = run(first, {scenario_path("open_field"), "--set", "oracle.range_sd_m=0.2", "--set", "gates=[]",
                          "--seeds", "3,1", "--particles", "7", "--filters", "ufastslam,ekf"});
  auto again = run(second, {(first / "resolved_scenario.yaml").string()});
  EXPECT_EQ(made["made_from"]["set"], nlohmann::json({"oracle.range_sd_m=0.2", "gates=[]"}));
  EXPECT_EQ(again["made_from"]["set"], nlohmann::json::array());
  again["made_from"]["set"] = made["made_from"]["set"];
  EXPECT_EQ(again.dump(2), made.dump(2));
  EXPECT_EQ(made["made_from"]["scenario_sha256"], sha256_of(bytes_of(first / "resolved_scenario.yaml")));
  EXPECT_EQ(run_stereobench({"--version"}).out, made["made_from"]["stereobench"].get<std::string>() + "\n");
  EXPECT_TRUE(made["made_from"]["pixels"].is_null());
}

// Mutations: names in place of contents; the fingerprint of no or of another frame than doctor's.
TEST(MadeFrom, NamesFilesByTheirContentAndPixelsByTheirFingerprint) {
  const TestFolder scratch;
  const std::string picture = (scratch.path() / "floor.png").string();
  const auto hash_with_grey = [&](int level) {
    cv::imwrite(picture, cv::Mat(16, 16, CV_8UC3, cv::Scalar::all(level)));
    const auto json =
        run(scratch.path() / "out",
            {scenario_path("ball_circle"), "--set", "path.laps=0.06", "--set", "gates=[]", "--seeds", "0",
             "--filters", "dead_reckoning", "--set",
             "world={balls: [{colour: 0, at_m: [2, 0, 0.05]}], floor_texture: {file: " + picture + "}}"});
    EXPECT_THAT(run_stereobench({"doctor"}).out,
                HasSubstr("fingerprint " + json["made_from"]["pixels"].get<std::string>() + "\n"));
    EXPECT_EQ(json["made_from"]["files_sha256"][picture], sha256_of_file(picture));
    return json["made_from"]["files_sha256"][picture].get<std::string>();
  };
  EXPECT_NE(hash_with_grey(100), hash_with_grey(101));
}

// Mutation: each cell with the first one's hash.
TEST(MadeFrom, OfASweepSaysItOfEachCell) {
  const TestFolder scratch;
  const Outcome outcome =
      run_stereobench({"sweep", scenario_path("open_field"), "--vary", "oracle.range_sd_m=0.1,0.2", "--seeds",
                       "0", "--particles", "5", "--filters", "ekf", "--out", scratch.path().string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto cells = nlohmann::json::parse(bytes_of(scratch.path() / "sweep.json"))["cells"];
  const auto &first = cells[0]["run"]["made_from"], &second = cells[1]["run"]["made_from"];
  EXPECT_EQ(first["set"], nlohmann::json({"oracle.range_sd_m=0.1"}));
  EXPECT_NE(first["scenario_sha256"], second["scenario_sha256"]);
  EXPECT_THAT(bytes_of(scratch.path() / "resolved_scenario.yaml"), HasSubstr("particles: 5"));
}

}  // namespace
}  // namespace stereobench::harness
