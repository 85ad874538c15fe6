#include "harness/dataset/formats/odometry/kitti_odometry_format.h"

#include <gmock/gmock.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

// Law: what the first camera sees of a ball, each pose takes to where its picture shows it. Mutations:
// inverse poses; the robot's axes; poses a frame late.
TEST(KittiOdometryFormat, HasThePosesOfTheLeftCameraInTheFirstOnesAxes) {
  const WrittenDrive drive("kitti-odometry");
  const auto lines = words_of(drive.text("poses/00.txt"));
  ASSERT_EQ(lines.size(), 3U);
  const worlds::Scenario& scenario = drive.scenario();
  const Eigen::Isometry3d world_from_first =
      world_from_camera(drive_of(scenario, scenario.world, 0), 0, Side::kLeft);
  for (std::size_t step = 0; step < 3; ++step) {
    const std::vector<double> numbers = as_numbers(lines[step]);
    ASSERT_EQ(numbers.size(), 12U);
    const Eigen::Vector2d seen = drive.ball_px(world_from_first * pose_of(numbers));
    EXPECT_LT((seen - drive.true_ball_px(step, Side::kLeft)).norm(), 1e-6) << step;
  }
  EXPECT_LT((pose_of(as_numbers(lines[0])).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
}

// Law: P3 times a point of the left camera's frame is its pixel in the right one. Mutations: a positive
// offset; an offset in metres.
TEST(KittiOdometryFormat, HasTheProjectionsOfBothCameras) {
  const WrittenDrive drive("kitti-odometry");
  const auto lines = words_of(drive.text("sequences/00/calib.txt"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[4].at(0), "Tr:");
  const std::vector<double> forward = as_numbers(lines[4], 1);
  EXPECT_EQ(Eigen::Vector3d(forward.at(0), forward.at(4), forward.at(8)), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  for (std::size_t camera = 0; camera < 4; ++camera) {
    EXPECT_EQ(lines[camera].at(0), "P" + std::to_string(camera) + ":");
    const std::vector<double> numbers = as_numbers(lines[camera], 1);
    ASSERT_EQ(numbers.size(), 12U);
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> projection(numbers.data());
    const Eigen::Vector3d pixel = projection * point.homogeneous();
    const vision::StereoRig& rig = drive.scenario().rig;
    const Eigen::Vector2d expected = vision::project(
        rig.intrinsics, vision::camera_point(rig, point, camera % 2 == 0 ? Side::kLeft : Side::kRight));
    EXPECT_LT((pixel.hnormalized() - expected).norm(), 1e-9) << camera;
  }
}

// Frames are counted without gaps, and times.txt says when they were. Mutation: numbers of steps.
TEST(KittiOdometryFormat, CountsTheFramesThatThereAre) {
  worlds::Scenario scenario = tilted_drive();
  const TestFolder folder;
  const DatasetDrive drive = drive_of(scenario, scenario.world, 7, {.first = 0, .last = 2, .stride = 2});
  const auto writer = kitti_odometry_writer(drive);
  std::string times;
  for (const DatasetFile& file : writer->drive_files({}))
    if (file.name == "sequences/07/times.txt") times = file.bytes();
  EXPECT_EQ(times, "0.000000e+00\n2.000000e-01\n");
}

// Mutations: the right picture on both sides; colour for grey.
TEST(KittiOdometryFormat, HasPicturesInGreyAndInColour) {
  const WrittenDrive drive("kitti-odometry");
  const renderer::StereoFrame frame = drive.frame(1);
  const auto differs = [&](const std::string& folder, const cv::Mat& picture) {
    return cv::norm(drive.picture("sequences/00/" + folder + "/000001.png"), picture, cv::NORM_INF);
  };
  EXPECT_EQ(differs("image_2", frame.left.colour), 0.0);
  EXPECT_EQ(differs("image_3", frame.right.colour), 0.0);
  for (const auto& [folder, colour] :
       {std::pair("image_0", frame.left.colour), std::pair("image_1", frame.right.colour)}) {
    cv::Mat grey(colour.size(), CV_8UC1);
    for (int v = 0; v < grey.rows; ++v)
      for (int u = 0; u < grey.cols; ++u) {
        const cv::Vec3b& bgr = colour.at<cv::Vec3b>(v, u);
        grey.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(0.114 * bgr[0] + 0.587 * bgr[1] +
                                                                      0.299 * bgr[2]);  // ITU-R BT.601
      }
    EXPECT_LE(differs(folder, grey), 1.0) << folder;
  }
}

// Mutation: each line of the check left out.
TEST(KittiOdometryFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.distortion", [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; }},
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT([&] { check_kitti_odometry_format(drive_of(scenario, scenario.world, 0)); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("the format kitti-odometry has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
