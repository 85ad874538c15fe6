#include "harness/dataset/formats/odometry/tum_format.h"

#include <gmock/gmock.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

// Law: the balls are where the poses say. Mutations: the robot's pose for the camera's; w first; inverse.
TEST(TumFormat, HasThePosesOfTheLeftCamera) {
  const WrittenDrive drive("tum");
  const auto lines = words_of(drive.text("groundtruth.txt"));
  ASSERT_EQ(lines.size(), 3U);
  for (std::size_t step = 0; step < 3; ++step) {
    const std::vector<double> n = as_numbers(lines[step]);
    ASSERT_EQ(n.size(), 8U);
    EXPECT_NEAR(n[0], 1.5e9 + 0.1 * static_cast<double>(step), 1e-6);
    const Eigen::Isometry3d pose = pose_of({n[1], n[2], n[3]}, n[7], n[4], n[5], n[6]);
    EXPECT_LT((drive.ball_px(pose) - drive.true_ball_px(step, Side::kLeft)).norm(), 1e-6) << step;
  }
}

// Mutations: 1000 levels a metre; the right camera's; what is nothing as the largest level.
TEST(TumFormat, HasDepthInLevelsOfAFifthOfAMillimetre) {
  worlds::Scenario scenario = tilted_drive();
  scenario.world.walls.front().height_m = 0.5;
  const WrittenDrive drive("tum", scenario);
  const cv::Mat levels = drive.picture("depth/1500000000.100000000.png");
  ASSERT_EQ(levels.type(), CV_16UC1);
  const cv::Mat depth_m = drive.frame(1).left.depth_m;
  int nothing = 0;
  for (int v = 0; v < levels.rows; ++v)
    for (int u = 0; u < levels.cols; ++u) {
      const double depth = depth_m.at<float>(v, u);
      const double level = levels.at<std::uint16_t>(v, u);
      if (depth < 13.1)
        ASSERT_NEAR(level / 5000.0, depth, 1.01e-4) << u << " " << v;
      else
        ASSERT_EQ(level, 0.0) << u << " " << v;
      nothing += level == 0.0 ? 1 : 0;
    }
  EXPECT_GT(nothing, 100);
  EXPECT_LT(nothing, levels.rows * levels.cols / 2);
}

// Mutation: steps without pictures are listed too.
TEST(TumFormat, ListsEachPicture) {
  const WrittenDrive drive("tum");
  for (const std::string folder : {"rgb", "depth"}) {
    const auto lines = words_of(drive.text(folder + ".txt"));
    ASSERT_EQ(lines.size(), 3U);
    for (const auto& line : lines) {
      EXPECT_EQ(line.at(1), folder + "/" + line.at(0) + ".png");
      EXPECT_TRUE(drive.has(line.at(1)));
    }
  }
  EXPECT_EQ(cv::norm(drive.picture("rgb/1500000000.200000000.png"), drive.frame(2).left.colour, cv::NORM_INF),
            0.0);
  const worlds::Scenario& scenario = drive.scenario();
  const DatasetDrive some = drive_of(scenario, scenario.world, 0, {.first = 0, .last = 2, .stride = 2});
  const auto writer = tum_writer(some);
  for (const char* name : {"rgb.txt", "depth.txt"}) {
    const auto files = writer->drive_files({});
    const auto list = std::ranges::find(files, name, &DatasetFile::name);
    ASSERT_NE(list, files.end()) << name;
    EXPECT_EQ(words_of(list->bytes()).size(), 2U) << name;
  }
}

// Mutation: each line of the check left out.
TEST(TumFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_tum_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format tum has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
