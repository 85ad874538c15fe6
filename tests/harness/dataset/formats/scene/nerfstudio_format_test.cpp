#include "harness/dataset/formats/scene/nerfstudio_format.h"

#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

// Law: by OpenGL's axes (y up, z backward), each frame shows the ball where the renderer says.
TEST(NerfstudioFormat, HasThePosesOfBothCamerasInAxesOfOpenGl) {
  const WrittenDrive drive("nerfstudio");
  const auto json = nlohmann::json::parse(drive.text("transforms.json"));
  ASSERT_EQ(json.at("frames").size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& frame = json.at("frames")[i];
    std::vector<double> numbers;
    for (const auto& row : frame.at("transform_matrix"))
      for (const auto& number : row) numbers.push_back(number);
    ASSERT_EQ(numbers.size(), 16U);
    const Eigen::Vector3d ball = pose_of(numbers).inverse() * drive.scenario().world.balls[0].centre_m;
    ASSERT_LT(ball.z(), 0.0);
    const Eigen::Vector2d px(
        json.at("cx").get<double>() - json.at("fl_x").get<double>() * ball.x() / ball.z(),
        json.at("cy").get<double>() + json.at("fl_y").get<double>() * ball.y() / ball.z());
    const Side side = i % 2 == 0 ? Side::kLeft : Side::kRight;
    EXPECT_LT((px - Eigen::Vector2d(0.5, 0.5) - drive.true_ball_px(i / 2, side)).norm(), 1e-6) << i;
    const renderer::StereoFrame seen = drive.frame(i / 2);
    EXPECT_EQ(cv::norm(drive.picture(frame.at("file_path")),
                       side == Side::kLeft ? seen.left.colour : seen.right.colour, cv::NORM_INF),
              0.0);
    const cv::Mat levels = drive.picture(frame.at("depth_file_path"));
    ASSERT_EQ(levels.type(), CV_16UC1);
    const cv::Mat& depth_m = side == Side::kLeft ? seen.left.depth_m : seen.right.depth_m;
    EXPECT_NEAR(levels.at<std::uint16_t>(60, 80), 1000.0 * static_cast<double>(depth_m.at<float>(60, 80)),
                0.51);
  }
}

TEST(NerfstudioFormat, HasTheLens) {
  worlds::Scenario scenario = tilted_drive();
  scenario.rig.distortion = {
      .k1 = -0.1, .k2 = 0.02, .p1 = 0.001, .p2 = -0.002, .k3 = 0.003, .pixel_aspect = 1.25};
  scenario.believed_rig = scenario.rig;
  const auto json = nlohmann::json::parse(WrittenDrive("nerfstudio", scenario).text("transforms.json"));
  const std::map<std::string, double> wanted = {
      {"fl_x", 140.0}, {"fl_y", 175.0}, {"cx", 76.75}, {"cy", 64.0}, {"w", 160.0},  {"h", 120.0},
      {"k1", -0.1},    {"k2", 0.02},    {"k3", 0.003}, {"k4", 0.0},  {"p1", 0.001}, {"p2", -0.002}};
  for (const auto& [key, value] : wanted) EXPECT_EQ(json.at(key), value) << key;
  EXPECT_EQ(json.at("camera_model"), "OPENCV");
}

TEST(NerfstudioFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_nerfstudio_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format nerfstudio has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
