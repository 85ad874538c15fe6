#include "harness/dataset/formats/kitti_format.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/dataset/formats/rectified_pair.h"
#include "harness/dataset/truth_pictures.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// What KITTI says of the cameras of every pair.
std::string cam_to_cam(const vision::StereoRig& rig) {
  std::string text;
  for (const auto& [camera, from_left_m] : {std::pair("02", 0.0), std::pair("03", rig.baseline_m)})
    text += fmt::format("S_rect_{0}: {1} {2}\nR_rect_{0}: 1 0 0 0 1 0 0 0 1\nP_rect_{0}: {3}\n", camera,
                        rig.intrinsics.width_px, rig.intrinsics.height_px, projection_row(rig, from_left_m));
  return text;
}

cv::Mat disparity_of_all(FrameTruth& truth) {
  return kitti_disparity(renderer::disparity_px(truth.to_other_camera(Side::kLeft), Side::kLeft));
}

cv::Mat disparity_of_seen(FrameTruth& truth) {
  cv::Mat disparity = disparity_of_all(truth);
  disparity.setTo(0, truth.to_other_camera(Side::kLeft).occlusion !=
                         static_cast<std::uint8_t>(renderer::Occlusion::kSeen));
  return disparity;
}

class KittiWriter final : public DatasetWriter {
 public:
  explicit KittiWriter(vision::StereoRig rig) : rig_(std::move(rig)) {}

  std::vector<DatasetFile> frame_files(const FrameEvent& event, FrameTruth& truth) const override {
    const auto file = [&](const char* folder, const char* ending) {
      return fmt::format("{}/{:06}{}", folder, event.step, ending);
    };
    return {picture_file(file("image_2", "_10.png"), event.pair.left),
            picture_file(file("image_3", "_10.png"), event.pair.right),
            picture_file(file("disp_occ_0", "_10.png"), [&truth] { return disparity_of_all(truth); }),
            picture_file(file("disp_noc_0", "_10.png"), [&truth] { return disparity_of_seen(truth); }),
            text_file(file("calib_cam_to_cam", ".txt"), cam_to_cam(rig_)),
            text_file(file("calib", ".txt"), fmt::format("P2: {}\nP3: {}\n", projection_row(rig_, 0.0),
                                                         projection_row(rig_, rig_.baseline_m)))};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }

 private:
  vision::StereoRig rig_;
};

}  // namespace

void check_kitti_format(const worlds::Scenario& scenario, const TruthRequest& truth) {
  std::string key = key_without_place(scenario);
  if (key.empty() && !truth.kinds.empty()) key = "--truth";
  if (key.empty()) return;
  throw std::runtime_error(
      fmt::format("--format kitti: has no place for {}; it holds rectified pairs of one instant, their "
                  "disparity and one calibration",
                  key));
}

std::unique_ptr<DatasetWriter> kitti_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiWriter>(drive.scenario.rig);
}

}  // namespace stereobench::harness
