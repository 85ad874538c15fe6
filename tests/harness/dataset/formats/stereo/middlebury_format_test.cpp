/// Middlebury's layout, and ETH3D's, which has the same files in other places.
#include "harness/dataset/formats/stereo/middlebury_format.h"

#include <cmath>

#include <gmock/gmock.h>

#include "harness/dataset/formats/stereo/eth3d_format.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// The number behind a key of calib.txt.
double value_of(const std::string& calibration, const std::string& key) {
  const std::size_t at = calibration.find(key + "=");
  return at == std::string::npos ? std::nan("") : std::stod(calibration.substr(at + key.size() + 1));
}

// Law: Z = baseline f / (d + doffs), as people compute it, in mm. Mutations: a baseline in metres; a right
// disparity that is negative; each camera with the other's.
TEST(MiddleburyFormat, HasTheDepthThatIsRendered) {
  const WrittenDrive drive("middlebury");
  const renderer::StereoFrame frame = drive.frame(1);
  const std::string calibration = drive.text("000001/calib.txt");
  EXPECT_THAT(calibration, HasSubstr("cam0=[140 0 76.25; 0 140 63.5; 0 0 1]\ncam1=[140 0 76.25; "));
  for (const auto& [name, depth_m] : {std::pair("000001/disp0.pfm", frame.left.depth_m),
                                      std::pair("000001/disp1.pfm", frame.right.depth_m)}) {
    const cv::Mat disparity = drive.picture(name);
    ASSERT_EQ(disparity.type(), CV_32FC1) << name;
    for (int v = 0; v < disparity.rows; ++v)
      for (int u = 0; u < disparity.cols; ++u) {
        const double z_mm = value_of(calibration, "baseline") * 140.0 /
                            (static_cast<double>(disparity.at<float>(v, u)) + value_of(calibration, "doffs"));
        const double depth = depth_m.at<float>(v, u);
        if (std::isfinite(depth))
          ASSERT_NEAR(z_mm, 1000.0 * depth, 2e-3 * 1000.0 * depth) << name << " " << u << " " << v;
        else
          ASSERT_FALSE(std::isfinite(disparity.at<float>(v, u)));
      }
  }
}

// Mutations: rounded inwards; nothing taken for the largest.
TEST(MiddleburyFormat, BoundsTheDisparities) {
  const WrittenDrive drive("middlebury");
  const std::string calibration = drive.text("000000/calib.txt");
  const cv::Mat disparity = drive.picture("000000/disp0.pfm");
  double least = 1e9, most = 0.0;
  for (int v = 0; v < disparity.rows; ++v)
    for (int u = 0; u < disparity.cols; ++u) {
      const double d = disparity.at<float>(v, u);
      if (!std::isfinite(d)) continue;
      least = std::min(least, d);
      most = std::max(most, d);
    }
  EXPECT_EQ(value_of(calibration, "vmin"), std::floor(least));
  EXPECT_EQ(value_of(calibration, "vmax"), std::ceil(most));
  EXPECT_GT(value_of(calibration, "ndisp"), most);
  EXPECT_EQ(value_of(calibration, "width"), 160);
  EXPECT_EQ(value_of(calibration, "height"), 120);
}

// Law: where both cameras see a point, the other picture's disparity there is the same. Mutations: occluded
// pixels as seen; masks exchanged.
TEST(MiddleburyFormat, SaysWhatBothCamerasSee) {
  worlds::Scenario under_the_sky = tilted_drive();
  under_the_sky.world.walls.clear();
  const WrittenDrive drive("middlebury", under_the_sky);
  const cv::Mat left = drive.picture("000001/disp0.pfm"), right = drive.picture("000001/disp1.pfm");
  for (const bool is_left : {true, false}) {
    const cv::Mat& here = is_left ? left : right;
    const cv::Mat& there = is_left ? right : left;
    const cv::Mat mask = drive.picture(is_left ? "000001/mask0nocc.png" : "000001/mask1nocc.png");
    int both = 0, alone = 0, nothing = 0, differ = 0;
    for (int v = 0; v < mask.rows; ++v)
      for (int u = 0; u < mask.cols; ++u) {
        const int level = mask.at<std::uint8_t>(v, u);
        ASSERT_EQ(level == 0, !std::isfinite(here.at<float>(v, u)));
        nothing += level == 0 ? 1 : 0;
        alone += level == 128 ? 1 : 0;
        if (level != 255) continue;
        ++both;
        const int column = static_cast<int>(
            std::lround(u + (is_left ? -1.0 : 1.0) * static_cast<double>(here.at<float>(v, u))));
        if (column < 0 || column >= mask.cols) continue;
        differ += std::abs(there.at<float>(v, column) - here.at<float>(v, u)) > 0.5F ? 1 : 0;
      }
    EXPECT_GT(both, 10000) << is_left;
    EXPECT_GT(alone, 100) << is_left;
    EXPECT_GT(nothing, 1000) << is_left;
    EXPECT_LT(differ, 40) << is_left;  // pixels across an outline
  }
}

// Mutation: a file of another step.
TEST(Eth3dFormat, HasTheFilesOfMiddleburysInItsOwnPlaces) {
  const WrittenDrive drive("eth3d"), same("middlebury");
  const std::string pictures = "two_view_training/000001/", truth = "two_view_training_gt/000001/";
  for (const auto& [name, other] :
       {std::pair(pictures + "im0.png", "im0.png"), std::pair(pictures + "im1.png", "im1.png"),
        std::pair(pictures + "calib.txt", "calib.txt"), std::pair(truth + "disp0GT.pfm", "disp0.pfm"),
        std::pair(truth + "mask0nocc.png", "mask0nocc.png")}) {
    EXPECT_FALSE(drive.text(name).empty()) << name;
    EXPECT_EQ(drive.text(name), same.text(std::string("000001/") + other)) << name;
  }
}

// Mutation: each line of the checks left out.
TEST(PairFolders, RefuseWhatTheyHaveNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"rig.right_turn_deg", [](worlds::Scenario& scenario) { scenario.rig.right_turn_rad.y() = 0.01; }},
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.right_delay_s", [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    const DatasetDrive drive = drive_of(scenario, scenario.world, 0);
    EXPECT_THAT(
        [&] { check_middlebury_format(drive); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format middlebury has no place for " + line)));
    EXPECT_THAT([&] { check_eth3d_format(drive); },
                ThrowsMessage<std::runtime_error>(HasSubstr("the format eth3d has no place for " + line)));
  }
}

}  // namespace
}  // namespace stereobench::harness
