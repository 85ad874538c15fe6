/// What people are shown of a frame that was rendered again.
#include "harness/frame_replay/frame_table.h"

#include <algorithm>
#include <sstream>

#include <Eigen/LU>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "harness/experiment/experiment.h"
#include "harness/frame_replay/replay_picture.h"
#include "harness/io/number_table.h"
#include "harness/io/text_table.h"
#include "harness/vision_scoring/detection_table.h"
#include "tests/harness/report/pixels.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Frame 2 of seed 0 of the circle. @param detector a line of the scenario; empty: ours
ReplayedFrame frame_by(const std::string& detector = {}) {
  Invocation invocation{.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml",
                        .overrides = {},
                        .folder = std::filesystem::current_path()};
  if (!detector.empty()) invocation.overrides.push_back(detector);
  const FrameName name{0, 2};
  return replay_frames(invocation, std::span(&name, 1)).front();
}

/// A program that finds nothing.
std::string blind_detector(const TestFolder& folder) {
  const auto file = folder.write("blind.py", R"(import json, sys
sys.stdin.readline()
for line in sys.stdin:
    print(json.dumps({"frame": json.loads(line)["frame"], "balls": []}), flush=True)
)");
  return "detector=/usr/bin/python3 " + file.string();
}

std::vector<std::string> lines_of_table(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  lines.erase(lines.begin(), lines.begin() + 2);  // the header
  return lines;
}

// The reference: numbers of detections.csv, of the same frame. Mutations: metres; left for right; variances.
TEST(FrameTable, SaysByHowMuchDetectionsAreOff) {
  const ReplayedFrame frame = frame_by();
  const TestFolder folder;
  const NumberTable table =
      read_csv_table(folder.write("detections.csv", detections_csv_header() + frame.rows),
                     {detections_csv_header().substr(0, detections_csv_header().size() - 1)});
  const std::vector<std::string> lines = lines_of_table(frame_table(frame));
  ASSERT_EQ(lines.size(), table.rows.size());
  ASSERT_GE(lines.size(), 2u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto number = [&](const char* name) {
      const auto column = std::ranges::find(table.columns, name) - table.columns.begin();
      return number_in(table, table.rows[i], static_cast<std::size_t>(column));
    };
    EXPECT_THAT(lines[i], StartsWith("true positive"));
    const Eigen::Vector2d error(number("range_m") - number("true_range_m"),
                                number("bearing_rad") - number("true_bearing_rad"));
    EXPECT_THAT(lines[i], HasSubstr(fmt::format(" {:+.3f} ", 1e3 * error.x())));
    EXPECT_THAT(lines[i], HasSubstr(fmt::format(" {:+.4f} ", 1e3 * error.y())));
    for (const std::string side : {"left", "right"})
      EXPECT_THAT(lines[i],
                  HasSubstr(fmt::format(
                      " ({:+.3f}, {:+.3f}) ",
                      number((side + "_x_px").c_str()) - number(("true_" + side + "_x_px").c_str()),
                      number((side + "_y_px").c_str()) - number(("true_" + side + "_y_px").c_str()))));
    Eigen::Matrix2d covariance;
    covariance << number("range_variance_m2"), number("range_bearing_covariance_m_rad"),
        number("range_bearing_covariance_m_rad"), number("bearing_variance_rad2");
    EXPECT_TRUE(lines[i].ends_with(" " + format_number(error.dot(covariance.inverse() * error) / 2.0)))
        << lines[i];
  }
}

// Mutations: balls that were missed left out; all that are ahead.
TEST(FrameTable, NamesBallsThatWereMissed) {
  const TestFolder folder;
  const ReplayedFrame frame = frame_by(blind_detector(folder));
  const std::vector<std::string> lines = lines_of_table(frame_table(frame));
  EXPECT_EQ(std::ssize(lines), std::ranges::count(frame.rows, '\n'));
  EXPECT_GE(lines.size(), 2u);
  for (const std::string& line : lines) EXPECT_THAT(line, StartsWith("miss "));
}

TEST(FrameTable, RowsOfAFrameAreFoundAgain) {
  const TestFolder folder;
  const std::string rows = "0,2,miss,0,1,3,2,0.1,100,100,90,100,12,1,1,50,,,,,,,,,,\n";
  const std::string other = "0,12,miss,0,1,3,2,0.1,100,100,90,100,12,1,1,50,,,,,,,,,,\n";
  const auto file = folder.write("detections.csv", detections_csv_header() + rows + other);
  EXPECT_EQ(rows_in_table(file, {0, 2}), rows);
  EXPECT_EQ(rows_in_table(file, {0, 12}), other);
  EXPECT_EQ(rows_in_table(file, {2, 0}), "");
}

// Mutations: no ball missed; borders of the other camera's balls.
TEST(ReplayPicture, ShowsMissedBallsInAnotherColour) {
  constexpr Colour kMissed = {1.0, 0.25, 0.1, 1.0}, kTrue = {0.337, 0.906, 0.914, 1.0};
  const TestFolder folder;
  const ReplayedFrame blind = frame_by(blind_detector(folder)), seen = frame_by();
  const cv::Mat missed = decoded(draw_replay_picture(blind)), found = decoded(draw_replay_picture(seen));
  EXPECT_EQ(missed.cols, 2048);
  EXPECT_GT(pixels_of(missed, kMissed, 40.0).size(), 200u);
  EXPECT_LT(pixels_of(found, kMissed, 40.0).size(), 10u);
  EXPECT_GT(pixels_of(found, kTrue, 40.0).size(), 200u);
  // Red pixels of the right half lie around balls of the right picture, labels aside.
  cv::Mat around;
  cv::dilate(blind.truth.right.ball_id, around, cv::Mat::ones(5, 5, CV_8U));
  long at_balls = 0, all = 0;
  for (const Point& point : pixels_of(missed(cv::Rect(1024, 0, 1024, 768)), kMissed, 40.0)) {
    ++all;
    at_balls += around.at<std::uint8_t>(static_cast<int>(point.y_px), static_cast<int>(point.x_px)) > 0;
  }
  EXPECT_GT(static_cast<double>(at_balls), 0.5 * static_cast<double>(all));
}

}  // namespace
}  // namespace stereobench::harness
