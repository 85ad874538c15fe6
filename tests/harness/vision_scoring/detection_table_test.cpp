#include "harness/vision_scoring/detection_table.h"

#include <cmath>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "tests/harness/commands/program.h"
#include "tests/harness/scoring/scene.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

/// A line of a table, by its columns' names.
using TableLine = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

std::vector<TableLine> lines_of(const std::string& csv) {
  std::istringstream stream(csv);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<TableLine> lines;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    TableLine& last = lines.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) last[names[i]] = cells[i];
  }
  return lines;
}

std::vector<TableLine> table_of(const Scene& scene,
                                const std::vector<vision::BallObservation>& observations) {
  const FrameMatch match = match_observations(scene.truth(), observations);
  return lines_of(detections_csv_header() + detection_rows({7, 3, scene.world, scene.rig}, match));
}

std::vector<std::string> column_of(const std::vector<TableLine>& lines, const std::string& name) {
  std::vector<std::string> column;
  for (const TableLine& line : lines) column.push_back(line.at(name));
  return column;
}

// Mutations: a flagged detection that finds its ball; a duplicate as right as the first; no line for a miss.
TEST(DetectionTable, HasALineForEachDetectionAndEachMiss) {
  const Scene scene({kAhead, kAside, kCut});
  const auto outlines = ball_outlines(scene.truth());
  const vision::BallObservation right = perfect(outlines[0], 3);
  vision::BallObservation elsewhere = right;
  elsewhere.left_px.x() += 60.0;
  vision::BallObservation flagged = perfect(outlines[1], 5);
  flagged.occluded = true;
  const auto lines = table_of(scene, {right, right, perfect(outlines[1], 4), elsewhere, flagged});
  EXPECT_THAT(column_of(lines, "outcome"), ElementsAre("true_positive", "duplicate", "wrong_identity",
                                                       "false_positive", "flagged", "miss"));
  EXPECT_THAT(column_of(lines, "ball"), ElementsAre("0", "0", "1", "", "1", "1"));
  EXPECT_THAT(column_of(lines, "required"), ElementsAre("1", "1", "1", "", "1", "1"));
  EXPECT_THAT(column_of(lines, "detected_colour"), ElementsAre("3", "3", "4", "3", "5", ""));
  for (const TableLine& line : lines) {
    EXPECT_EQ(line.at("seed"), "7");
    EXPECT_EQ(line.at("frame"), "3");
    EXPECT_EQ(line.at("range_m").empty(), line.at("outcome") == "miss");
  }
}

// Mutation: the border of one camera alone; columns of the truth and of the detection in each other's place.
TEST(DetectionTable, SaysWhereABallIsAndWhereItWasSeen) {
  const Scene scene({kAhead});
  const auto outlines = ball_outlines(scene.truth());
  vision::BallObservation seen = perfect(outlines[0], 3);
  seen.right_px.x() += 0.25;
  const TableLine line = table_of(scene, {seen}).at(0);
  const auto number = [&line](const char* name) { return std::stod(line.at(name)); };
  EXPECT_EQ(number("right_x_px") - number("true_right_x_px"), 0.25);
  EXPECT_EQ(number("left_x_px"), number("true_left_x_px"));
  EXPECT_EQ(number("true_range_m"), outlines[0].ball_in_robot.head<2>().norm());
  const vision::OutlineEllipse& left = outlines[0].left;
  const vision::OutlineEllipse& right = outlines[0].right;
  const double nearest = std::min(
      {left.centre_px.x() - left.half_extent_px().x(), right.centre_px.x() - right.half_extent_px().x(),
       319.0 - left.centre_px.x() - left.half_extent_px().x(), left.centre_px.y() - left.half_extent_px().y(),
       239.0 - left.centre_px.y() - left.half_extent_px().y()});
  EXPECT_NEAR(number("border_px"), nearest + 0.5, 1e-9);
}

std::string unpacked(const std::filesystem::path& file) {
  gzFile stream = gzopen(file.c_str(), "rb");
  std::string text;
  std::array<char, 4096> part{};
  for (int count = 0; (count = gzread(stream, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(count));
  gzclose(stream);
  return text;
}

/// What became of the detections of a run, counted in its table and in its run.json.
void expect_same_counts(const std::vector<std::string>& more) {
  const TestFolder scratch;
  const Outcome outcome = run_stereobench(
      with({"run", scenario_path("ball_circle"), "--set", "path.laps=0.1", "--set", "gates=[]", "--seeds",
            "4,1", "--filters", "ekf", "--jobs", "2", "--out", scratch.path().string()},
           more));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(unpacked(scratch.path() / "detections.csv.gz"));
  std::map<std::string, int> counts;
  double squares = 0.0;
  for (const TableLine& line : lines) {
    ++counts[line.at("outcome")];
    if (line.at("outcome") != "true_positive") continue;
    squares += std::pow(std::stod(line.at("range_m")) - std::stod(line.at("true_range_m")), 2);
    counts["found"] += line.at("required") == "1" ? 1 : 0;
  }
  const auto vision = nlohmann::json::parse(bytes_of(scratch.path() / "run.json")).at("vision");
  EXPECT_GT(counts["true_positive"], 20);
  EXPECT_EQ(vision.at("found"), counts["found"]);
  EXPECT_EQ(vision.at("visible"), counts["found"] + counts["miss"]);
  EXPECT_EQ(vision.at("spurious"), counts["false_positive"]);
  EXPECT_EQ(vision.at("misidentified"), counts["wrong_identity"]);
  EXPECT_EQ(vision.at("repeated"), counts["duplicate"]);
  EXPECT_EQ(vision.at("flagged"), counts["flagged"]);
  const double rms_m = std::sqrt(squares / counts["true_positive"]);
  EXPECT_NEAR(vision.at("range_rms_m").get<double>() / rms_m, 1.0, 1e-9);
  EXPECT_EQ(lines.front().at("seed"), "4");
  EXPECT_EQ(lines.back().at("seed"), "1");
}

// Law: what run.json says of vision can be worked out from the table.
// Mutations: the first seed's lines alone; numbers that are rounded.
TEST(DetectionTable, AddsUpToTheRun) {
  expect_same_counts({});
}

// The same of a detector that misses balls. Skipped without Debian's python3-opencv.
TEST(DetectionTable, AddsUpToTheRunOfASimpleDetector) {
  if (std::system("/usr/bin/python3 -c 'import cv2' 2>/dev/null") != 0) GTEST_SKIP() << "no python3-opencv";
  expect_same_counts(
      {"--detector", "/usr/bin/python3 " STEREOBENCH_SOURCE_DIR "/assets/detectors/colour_blobs.py"});
}

}  // namespace
}  // namespace stereobench::harness
