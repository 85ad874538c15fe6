#include "harness/dataset/formats/odometry/vslamlab_format.h"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

// Law: the pose of the body times that of a camera on it says where its picture shows a ball. Mutations: the
// robot for the body; the right camera's transform inverted; w first.
TEST(VslamlabFormat, HasThePosesOfBothCameras) {
  const WrittenDrive drive("vslamlab");
  const auto poses = words_of(drive.text("groundtruth.csv"));
  const YAML::Node cameras = YAML::Load(drive.text("calibration.yaml"))["cameras"];
  ASSERT_EQ(poses.size(), 4U);  // a header and three steps
  ASSERT_EQ(cameras.size(), 2U);
  for (const Side side : kBothSides) {
    const YAML::Node camera = cameras[side == Side::kLeft ? 0 : 1];
    EXPECT_EQ(camera["cam_name"].as<std::string>(), side == Side::kLeft ? "rgb_0" : "rgb_1");
    const Eigen::Isometry3d body_from_camera = pose_of(camera["T_BS"].as<std::vector<double>>());
    for (std::size_t step = 0; step < 3; ++step) {
      const std::vector<double> n = as_numbers(poses[step + 1]);
      ASSERT_EQ(n.size(), 8U);
      const Eigen::Isometry3d body = pose_of({n[1], n[2], n[3]}, n[7], n[4], n[5], n[6]);
      EXPECT_LT((drive.ball_px(body * body_from_camera) - drive.true_ball_px(step, side)).norm(), 1e-6);
    }
  }
}

// Mutations: k3 before p1; width and height exchanged; the rate of steps.
TEST(VslamlabFormat, HasTheLens) {
  worlds::Scenario scenario = tilted_drive();
  scenario.rig.distortion = {
      .k1 = -0.1, .k2 = 0.02, .p1 = 0.001, .p2 = -0.002, .k3 = 0.003, .pixel_aspect = 1.25};
  scenario.believed_rig = scenario.rig;
  const YAML::Node camera =
      YAML::Load(WrittenDrive("vslamlab", scenario).text("calibration.yaml"))["cameras"][1];
  const auto numbers = [&](const char* key) { return camera[key].as<std::vector<double>>(); };
  EXPECT_EQ(numbers("focal_length"), (std::vector<double>{140.0, 175.0}));
  EXPECT_EQ(numbers("principal_point"), (std::vector<double>{76.25, 63.5}));
  EXPECT_EQ(numbers("distortion_coefficients"), (std::vector<double>{-0.1, 0.02, 0.001, -0.002, 0.003}));
  EXPECT_EQ(numbers("image_dimension"), (std::vector<double>{160, 120}));
  EXPECT_EQ(camera["fps"].as<double>(), 10.0);
}

// Mutation: the left picture on both sides.
TEST(VslamlabFormat, ListsBothPicturesOfEachPair) {
  const WrittenDrive drive("vslamlab");
  const auto pairs = words_of(drive.text("rgb.csv"));
  ASSERT_EQ(pairs.size(), 4U);
  const auto& pair = pairs[2];
  ASSERT_EQ(pair.size(), 4U);
  EXPECT_EQ(pair[0], "1500000000100000000");
  EXPECT_EQ(pair[2], pair[0]);
  const renderer::StereoFrame frame = drive.frame(1);
  EXPECT_EQ(cv::norm(drive.picture(pair[1]), frame.left.colour, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(drive.picture(pair[3]), frame.right.colour, cv::NORM_INF), 0.0);
}

// Mutation: each line of the check left out.
TEST(VslamlabFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_vslamlab_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format vslamlab has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
