#include "harness/dataset/formats/stereo/kitti_stereo_format.h"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/harness/dataset/formats/written_drive.h"

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
    StepWriter writer(folder_, scenario_, dataset_format("kitti-stereo"), {});
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
  for (const char* key : {"S_0", "K_0", "D_0", "R_0", "T_0", "S_rect_0", "R_rect_0", "P_rect_0"})
    for (int camera = 0; camera < 4; ++camera)
      EXPECT_FALSE(numbers_of(text, key + std::to_string(camera)).empty()) << key << camera;
  EXPECT_EQ(numbers_of(text, "T_03"), (std::vector<double>{-scenario_.rig.baseline_m, 0, 0}));
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

// Law: a point's disparity at the next step is that of the pixel there that the flow leads to. Mutations: the
// disparity of now; the next camera's pose inverted; what is hidden then in disp_noc_1.
TEST_F(KittiFormat, HasTheDisparityOfTheNextStep) {
  const WrittenDrive drive("kitti-scene-flow", scenario_);
  const cv::Mat later = drive.picture("disp_occ_1/000000_10.png"),
                seen = drive.picture("disp_noc_1/000000_10.png");
  const cv::Mat flow = drive.picture("flow_noc/000000_10.png"),
                next = drive.picture("disp_occ_0/000001_10.png");
  ASSERT_EQ(flow.type(), CV_16UC3);
  int compared = 0, differ = 0;
  for (int v = 0; v < flow.rows; ++v)
    for (int u = 0; u < flow.cols; ++u) {
      const cv::Vec3w& bgr = flow.at<cv::Vec3w>(v, u);
      ASSERT_EQ(bgr[0] == 1, seen.at<std::uint16_t>(v, u) != 0) << u << " " << v;
      if (bgr[0] == 0) continue;
      ASSERT_EQ(seen.at<std::uint16_t>(v, u), later.at<std::uint16_t>(v, u));
      const cv::Point place(static_cast<int>(std::lround(u + (bgr[2] - 32768.0) / 64.0)),
                            static_cast<int>(std::lround(v + (bgr[1] - 32768.0) / 64.0)));
      if (!cv::Rect(0, 0, flow.cols, flow.rows).contains(place)) continue;
      ++compared;
      differ += std::abs(next.at<std::uint16_t>(place) - seen.at<std::uint16_t>(v, u)) > 64 ? 1 : 0;
    }
  EXPECT_GT(compared, 8000);
  EXPECT_LT(differ, compared / 100);  // pixels across an outline
}

// A second pair is the next step's; the last step is one alone. Mutations: the pair itself; pairs without a
// second one.
TEST_F(KittiFormat, HasTheNextStepsPairBesideEachOne) {
  const WrittenDrive drive("kitti-scene-flow", scenario_);
  for (const std::string folder : {"image_2/", "image_3/"}) {
    EXPECT_EQ(drive.text(folder + "000000_11.png"), drive.text(folder + "000001_10.png"));
    EXPECT_TRUE(drive.has(folder + "000001_11.png"));
    EXPECT_FALSE(drive.has(folder + "000002_10.png"));
  }
  EXPECT_FALSE(drive.has("flow_occ/000002_10.png"));
  const WrittenDrive stereo("kitti-stereo", scenario_);
  EXPECT_FALSE(stereo.has("image_2/000000_11.png"));
  EXPECT_EQ(cv::countNonZero(stereo.picture("disp_occ_1/000002_10.png")), 0);
}

// Mutation: a folder of 2015.
TEST_F(KittiFormat, HasTheSameFilesInTheFoldersOf2012) {
  const WrittenDrive of_2012("kitti-stereo-2012", scenario_), of_2015("kitti-stereo", scenario_);
  for (const auto& [older, newer] :
       {std::pair("colored_0", "image_2"), std::pair("colored_1", "image_3"),
        std::pair("disp_occ", "disp_occ_0"), std::pair("disp_noc", "disp_noc_0")}) {
    EXPECT_FALSE(of_2012.text(std::string(older) + "/000001_10.png").empty()) << older;
    EXPECT_EQ(of_2012.text(std::string(older) + "/000001_10.png"),
              of_2015.text(std::string(newer) + "/000001_10.png"));
  }
  EXPECT_EQ(numbers_of(of_2012.text("calib/000001.txt"), "P1"),
            numbers_of(of_2015.text("calib/000001.txt"), "P3"));
  EXPECT_FALSE(of_2012.has("disp_occ_1/000000_10.png"));
  EXPECT_EQ(of_2012.picture("image_1/000001_10.png").type(), CV_8UC1);
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
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }},
      {"shutter.late_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; }},
      {"shutter.drop_probability",
       [](worlds::Scenario& scenario) { scenario.shutter.drop_probability = 0.1; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    EXPECT_NO_THROW(check_kitti_stereo_format(drive_of(scenario, scenario.world, 0)));
    EXPECT_NO_THROW(check_kitti_scene_flow_format(drive_of(scenario, scenario.world, 0)));
    change(scenario);
    EXPECT_THAT([&] { check_kitti_stereo_format(drive_of(scenario, scenario.world, 0)); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("the format kitti-stereo has no place for " + line + ";")));
  }
}

// Mutation: no look at which frames there are.
TEST(KittiLimits, NeedTwoFramesInARowForAFlow) {
  const worlds::Scenario scenario = room_drive();
  const DatasetDrive drive = drive_of(scenario, scenario.world, 0, {.first = 0, .last = 2, .stride = 2});
  EXPECT_THAT(
      [&] { check_kitti_scene_flow_format(drive); },
      ThrowsMessage<std::runtime_error>(HasSubstr("has no place for --frames without two in a row;")));
  EXPECT_NO_THROW(check_kitti_stereo_2012_format(drive));
}

// Mutations: the check of one of the layouts left out.
TEST(KittiLimits, AreThoseOfAllLayouts) {
  worlds::Scenario scenario = room_drive();
  scenario.shutter.drop_probability = 0.1;
  const DatasetDrive lossy = drive_of(scenario, scenario.world, 0);
  EXPECT_ANY_THROW(check_kitti_scene_flow_format(lossy));
  EXPECT_NO_THROW(check_kitti_stereo_2012_format(lossy));
  scenario.rig.distortion.k1 = 0.1;
  EXPECT_ANY_THROW(check_kitti_stereo_2012_format(drive_of(scenario, scenario.world, 0)));
}

}  // namespace
}  // namespace stereobench::harness
