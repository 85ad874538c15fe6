/// Worlds left to chance, as a user renders and replays them.
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

const std::string kAll =
    "randomise={ball_colours: {}, walls: {}, floor: {}, light: {}, clutter: {}, distractors: {count: 3}}";

std::vector<nlohmann::json> json_lines_of(const std::filesystem::path& file) {
  std::vector<nlohmann::json> lines;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

std::vector<std::string> with_world(std::vector<std::string> arguments, const std::string& randomise = kAll) {
  for (const std::string& line :
       {std::string("path.laps=0.06"), std::string("rig.width_px=512"), std::string("rig.height_px=384"),
        std::string("rig.focal_px=443"), randomise})
    arguments.insert(arguments.end(), {"--set", line});
  return arguments;
}

/// Renders a drawn world to "drawn", writes it to "plain.yaml" and "draws.jsonl", renders that to "again",
/// and expects the same files.
void expect_the_same_bytes_once_written_out(const TestFolder& folder, const std::string& randomise) {
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto succeed = [](const std::vector<std::string>& arguments) {
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  };
  const std::string scenario = scenario_path("ball_circle");
  succeed(with_world({"render", scenario, "--seed", "3", "--truth", "surface", "--out", path("drawn")},
                     randomise));
  succeed(with_world(
      {"world", scenario, "--seed", "3", "--write", path("plain.yaml"), "--draws", path("draws.jsonl")},
      randomise));
  succeed({"render", path("plain.yaml"), "--seed", "3", "--out", path("again")});
  for (const char* file : {"left/000000.png", "right/000001.png", "left_depth/000002.pfm",
                           "left_id/000001.png", "balls.csv", "observations.csv"})
    EXPECT_EQ(bytes_of(folder.path() / "drawn" / file), bytes_of(folder.path() / "again" / file)) << file;
  EXPECT_EQ(bytes_of(folder.path() / "drawn/draws.jsonl"), bytes_of(path("draws.jsonl")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "again/draws.jsonl"));
}

// The drawn world, written as a plain scenario, gives the same bytes; another seed other ones.
// Mutation: jitter kept in the written scenario.
TEST(RandomisedWorld, RendersTheSameBytesOnceWrittenOut) {
  const TestFolder folder;
  expect_the_same_bytes_once_written_out(folder, kAll);
  const std::string other = (folder.path() / "other").string();
  ASSERT_EQ(
      run_stereobench(with_world({"render", scenario_path("ball_circle"), "--seed", "5", "--out", other}))
          .exit_code,
      0);
  EXPECT_NE(bytes_of(folder.path() / "drawn/left/000000.png"),
            bytes_of(folder.path() / "other/left/000000.png"));
}

/// A picture of random blocks, as a file.
std::string write_blocks(const TestFolder& folder, const char* name, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat small(8, 8, CV_8UC3), large;
  random.fill(small, cv::RNG::UNIFORM, 0, 255);
  cv::resize(small, large, {64, 64}, 0.0, 0.0, cv::INTER_NEAREST);
  const std::string file = (folder.path() / name).string();
  cv::imwrite(file, large);
  return file;
}

// The same with pictures on walls and floor. Meant to catch: the first texture for all walls once written.
TEST(RandomisedWorld, ShowsTheSameTexturesOnceWrittenOut) {
  const TestFolder folder;
  const std::string textures = "textures: [{file: " + write_blocks(folder, "a.png", 1) +
                               ", tile_m: 0.8}, {file: " + write_blocks(folder, "b.jpg", 2) + "}]";
  expect_the_same_bytes_once_written_out(folder,
                                         "randomise={walls: {" + textures + "}, floor: {" + textures + "}}");
  std::set<std::string> drawn;
  for (const nlohmann::json& line : json_lines_of(folder.path() / "draws.jsonl"))
    if (line["key"].get<std::string>().ends_with(".material")) drawn.insert(line["value"].get<std::string>());
  EXPECT_EQ(drawn, (std::set<std::string>{"a.png", "b.jpg"}));
}

// What looks like a ball is a surface in truth. Mutation: shapes numbered among the balls.
TEST(RandomisedWorld, HasDistractorsInTruthAsSurfaces) {
  const TestFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  ASSERT_EQ(run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.5", "--set",
                             "rig.width_px=512", "--set", "rig.height_px=384", "--set", "rig.focal_px=443",
                             "--set", "randomise={distractors: {count: 8, range_m: [0.5, 1.5]}}", "--truth",
                             "surface", "--out", path("set")})
                .exit_code,
            0);
  std::ifstream balls(folder.path() / "set/balls.csv");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(balls), {}, '\n'), 19) << "18 balls and a head";
  std::set<int> seen;
  for (int step = 0; step < 18; ++step) {
    const std::string name = (step < 10 ? "00000" : "0000") + std::to_string(step) + ".png";
    const cv::Mat surface = cv::imread(path("set/left_surface/") + name, cv::IMREAD_UNCHANGED);
    const cv::Mat id = cv::imread(path("set/left_id/") + name, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(surface.type(), CV_16UC1);
    for (int i = 0; i < static_cast<int>(surface.total()); ++i) {
      const int number = surface.at<std::uint16_t>(i);
      if (number < 256 + 4 + 12) continue;  // beyond the walls and the columns of ball_circle
      seen.insert(number);
      ASSERT_EQ(id.at<std::uint8_t>(i), 0);
    }
  }
  EXPECT_GE(seen.size(), 3U);
}

// Mutation: what is drawn for all seeds that of the first.
TEST(RandomisedWorld, EachSeedOfARunDrawsItsOwn) {
  const TestFolder folder;
  const auto out = [&](const char* name) { return (folder.path() / name).string(); };
  for (const char* jobs : {"1", "2"})
    ASSERT_EQ(run_stereobench(
                  with_world({"run", scenario_path("ball_circle"), "--seeds", "2..4", "--filters",
                              "dead_reckoning", "--set", "gates=[]", "--jobs", jobs, "--out", out(jobs)}))
                  .exit_code,
              0);
  EXPECT_EQ(bytes_of(folder.path() / "1/run.json"), bytes_of(folder.path() / "2/run.json"));
  std::set<double> ambients;
  for (const nlohmann::json& line : json_lines_of(folder.path() / "1/draws.jsonl"))
    if (line["key"] == "light.ambient") {
      ambients.insert(line["value"].get<double>());
      EXPECT_EQ(line["from"], nlohmann::json({0.35, 0.55}));
    }
  EXPECT_EQ(ambients.size(), 3U);
}

// Without noise nothing but the world makes a difference to what is seen.
// Mutation: the first seed's world for all.
TEST(RandomisedWorld, OfEachSeedIsTheOneThatIsLookedAt) {
  const TestFolder folder;
  std::set<double> errors;
  for (const char* seeds : {"2", "3", "3,2"}) {
    const std::string out = (folder.path() / seeds).string();
    const Outcome outcome = run_stereobench(
        with_world({"run", scenario_path("ball_circle"), "--seeds", seeds, "--filters", "dead_reckoning",
                    "--set", "gates=[]", "--set", "camera.noise_sd_levels=0", "--out", out}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    errors.insert(nlohmann::json::parse(bytes_of(folder.path() / seeds / "run.json"))["vision"]["range_rms_m"]
                      .get<double>());
  }
  EXPECT_EQ(errors.size(), 3U);
}

}  // namespace
}  // namespace stereobench::harness
