#include "harness/dataset/formats/stereo/sceneflow_format.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

// Law: a ball is where the poses say, once the camera's axes are turned from Blender's to OpenCV's.
// Mutations: OpenCV's axes; the left camera's pose for both.
TEST(SceneflowFormat, HasThePosesOfBothCamerasInBlendersAxes) {
  const WrittenDrive drive("sceneflow");
  const auto lines = words_of(drive.text("camera_data/room_0/camera_data.txt"));
  ASSERT_EQ(lines.size(), 9U);
  const Eigen::Vector3d signs(1.0, -1.0, -1.0);
  for (std::size_t step = 0; step < 3; ++step) {
    EXPECT_EQ(lines[3 * step], (std::vector<std::string>{"Frame", std::to_string(step)}));
    for (const std::size_t i : {1U, 2U}) {
      const auto& line = lines[3 * step + i];
      EXPECT_EQ(line.at(0), i == 1 ? "L" : "R");
      Eigen::Isometry3d pose = pose_of(as_numbers(line, 1));
      pose.linear() = pose.linear() * signs.asDiagonal();
      const Eigen::Vector2d expected = drive.true_ball_px(step, i == 1 ? Side::kLeft : Side::kRight);
      EXPECT_LT((drive.ball_px(pose) - expected).norm(), 1e-6) << step;
    }
  }
}

// Law: the flow takes a pixel of the nearer ball to a pixel of it in the next picture. Mutations: flow to
// the step before; columns and rows exchanged.
TEST(SceneflowFormat, HasTheFlowToTheNextStep) {
  const WrittenDrive drive("sceneflow");
  for (const bool is_left : {true, false}) {
    const cv::Mat flow =
        drive.picture(is_left ? "optical_flow/room_0/into_future/left/OpticalFlowIntoFuture_0001_L.pfm"
                              : "optical_flow/room_0/into_future/right/OpticalFlowIntoFuture_0001_R.pfm");
    ASSERT_EQ(flow.type(), CV_32FC3);
    const renderer::StereoFrame now = drive.frame(1), next = drive.frame(2);
    const cv::Mat& here = is_left ? now.left.ball_id : now.right.ball_id;
    const cv::Mat& there = is_left ? next.left.ball_id : next.right.ball_id;
    int compared = 0, lost = 0;
    for (int v = 0; v < here.rows; ++v)
      for (int u = 0; u < here.cols; ++u) {
        if (here.at<std::uint8_t>(v, u) != 1) continue;
        const cv::Vec3f& shift = flow.at<cv::Vec3f>(v, u);  // blue, green, red
        EXPECT_EQ(shift[0], 0.0F);
        const cv::Point place(static_cast<int>(std::lround(static_cast<float>(u) + shift[2])),
                              static_cast<int>(std::lround(static_cast<float>(v) + shift[1])));
        ++compared;
        if (!cv::Rect(0, 0, here.cols, here.rows).contains(place) || there.at<std::uint8_t>(place) != 1)
          ++lost;
      }
    EXPECT_GT(compared, 100);
    EXPECT_LT(lost, 15);  // at its outline
  }
  EXPECT_FALSE(drive.has("optical_flow/room_0/into_future/left/OpticalFlowIntoFuture_0002_L.pfm"));
}

// Mutation: the cameras exchanged.
TEST(SceneflowFormat, HasPicturesAndDisparities) {
  const WrittenDrive drive("sceneflow");
  const renderer::StereoFrame frame = drive.frame(2);
  const auto picture = [&](const std::string& name) { return drive.picture(name); };
  EXPECT_EQ(cv::norm(picture("frames_cleanpass/room_0/left/0002.png"), frame.left.colour, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(picture("frames_cleanpass/room_0/right/0002.png"), frame.right.colour, cv::NORM_INF),
            0.0);
  for (const auto& [side, depth_m] :
       {std::pair("left", frame.left.depth_m), std::pair("right", frame.right.depth_m)}) {
    const cv::Mat disparity = picture(std::string("disparity/room_0/") + side + "/0002.pfm");
    const float depth = depth_m.at<float>(60, 80);
    EXPECT_NEAR(disparity.at<float>(60, 80), 140.0 * 0.12 / static_cast<double>(depth), 0.01) << side;
  }
}

// Mutation: each line of the check left out.
TEST(SceneflowFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.distortion", [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; }},
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }},
      {"shutter.drop_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.drop_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_sceneflow_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format sceneflow has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
