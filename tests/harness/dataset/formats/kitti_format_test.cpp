#include "harness/dataset/formats/kitti_format.h"

#include <sstream>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/harness/dataset/step_writer.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

cv::Mat kitti_picture(const TestFolder& folder, const std::string& name) {
  return cv::imread((folder.path() / name).string(), cv::IMREAD_UNCHANGED);
}

/// The numbers behind a key of a calibration file, as KITTI's readers take them.
std::vector<double> numbers_of(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  std::vector<double> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key + ": ")) continue;
    std::istringstream values(line.substr(key.size() + 2));
    for (double value = 0.0; values >> value;) numbers.push_back(value);
  }
  return numbers;
}

class KittiFormat : public testing::Test {
 protected:
  const worlds::Scenario scenario_ = room_drive();
  const TestFolder folder_;
  const renderer::StereoFrame frame_ =
      renderer::Renderer(scenario_.world, scenario_.rig).render(scenario_.path[1].pose);
  void SetUp() override {
    StepWriter writer(folder_, scenario_, dataset_format("kitti"), {});
    writer.write(1, frame_);
    writer.finish();
  }
};

// Law: depth = (P2[3] - P3[3]) / disparity, with the renderer's own depth, as people compute it. Mutations:
// the right camera's disparity; P3 with a positive offset; 128 levels a pixel.
TEST_F(KittiFormat, HasTheDepthThatIsRendered) {
  const std::string calibration = folder_.read("calib/000001.txt");
  const std::vector<double> p2 = numbers_of(calibration, "P2"), p3 = numbers_of(calibration, "P3");
  ASSERT_EQ(p2.size(), 12U);
  ASSERT_EQ(p3.size(), 12U);
  const cv::Mat disparity = kitti_picture(folder_, "disp_occ_0/000001_10.png");
  ASSERT_EQ(disparity.type(), CV_16UC1);
  int compared = 0;
  for (int v = 0; v < disparity.rows; ++v)
    for (int u = 0; u < disparity.cols; ++u) {
      const double depth_m = frame_.left.depth_m.at<float>(v, u);
      const std::uint16_t level = disparity.at<std::uint16_t>(v, u);
      ASSERT_EQ(level == 0, !std::isfinite(depth_m)) << u << " " << v;
      if (level == 0) continue;
      EXPECT_NEAR((p2[3] - p3[3]) / depth_m, level / 256.0, 0.003);
      ++compared;
    }
  EXPECT_GT(compared, 10000);
}

// Mutations: both cameras the left one; rows and columns exchanged.
TEST_F(KittiFormat, ProjectsWhereTheCamerasDo) {
  const std::string text = folder_.read("calib_cam_to_cam/000001.txt");
  EXPECT_EQ(numbers_of(text, "S_rect_02"), (std::vector<double>{160, 120}));
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  for (const auto& [key, side] :
       {std::pair("P_rect_02", vision::Side::kLeft), std::pair("P_rect_03", vision::Side::kRight)}) {
    const std::vector<double> numbers = numbers_of(text, key);
    ASSERT_EQ(numbers.size(), 12U);
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> projection(numbers.data());
    const Eigen::Vector3d pixel = projection * point.homogeneous();
    const Eigen::Vector2d expected =
        vision::project(scenario_.rig.intrinsics, vision::camera_point(scenario_.rig, point, side));
    EXPECT_LT((pixel.hnormalized() - expected).norm(), 1e-9) << key;
  }
}

// Of what the right camera does not see, disp_noc says nothing; of all else the same. Mutations: occluded
// pixels in both; those seen in none.
TEST_F(KittiFormat, LeavesOccludedPixelsOutOfOneOfTheTwo) {
  const cv::Mat all = kitti_picture(folder_, "disp_occ_0/000001_10.png");
  const cv::Mat seen = kitti_picture(folder_, "disp_noc_0/000001_10.png");
  const cv::Mat differs = all != seen;
  EXPECT_EQ(cv::countNonZero(differs & (seen != 0)), 0);
  const int hidden = cv::countNonZero(differs);
  EXPECT_GT(hidden, 100);  // the left border, and beside the balls
  EXPECT_LT(hidden, 4000);
  EXPECT_EQ(cv::countNonZero(differs.colRange(110, 160)), 0);
}

TEST_F(KittiFormat, HasBothPicturesAsTheyAreTaken) {
  EXPECT_EQ(cv::norm(kitti_picture(folder_, "image_2/000001_10.png"), frame_.left.colour, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(kitti_picture(folder_, "image_3/000001_10.png"), frame_.right.colour, cv::NORM_INF),
            0.0);
}

// Mutation: each line of the check left out.
TEST(KittiLimits, AreNamedWithTheLineThatIsInTheWay) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.distortion", [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; }},
      {"rig.pixel_aspect", [](worlds::Scenario& scenario) { scenario.rig.distortion.pixel_aspect = 1.1; }},
      {"rig.right_turn_deg", [](worlds::Scenario& scenario) { scenario.rig.right_turn_rad.y() = 0.01; }},
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }},
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    EXPECT_NO_THROW(check_kitti_format(scenario, {}));
    change(scenario);
    EXPECT_THAT(
        [&] { check_kitti_format(scenario, {}); },
        ThrowsMessage<std::runtime_error>(HasSubstr("--format kitti: has no place for " + line + ";")));
  }
  EXPECT_THAT([] { check_kitti_format(room_drive(), {{TruthKind::kFlow}}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("has no place for --truth;")));
}

}  // namespace
}  // namespace stereobench::harness
