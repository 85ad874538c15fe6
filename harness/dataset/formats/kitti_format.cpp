#include "harness/dataset/formats/kitti_format.h"

#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/truth_pictures.h"
#include "harness/io/calibration_file.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// A projection of a rectified camera, row by row. @param from_left_m how far right of the left camera it is
std::string projection(const vision::StereoRig& rig, double from_left_m) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const double f = camera.focal_px;
  return fmt::format("{} 0 {} {} 0 {} {} 0 0 0 1 0", f, camera.cx_px,
                     from_left_m == 0.0 ? 0.0 : -f * from_left_m, f, camera.cy_px);
}

/// What KITTI says of the cameras of every pair.
std::string cam_to_cam(const vision::StereoRig& rig) {
  std::string text;
  for (const auto& [camera, from_left_m] : {std::pair("02", 0.0), std::pair("03", rig.baseline_m)})
    text += fmt::format("S_rect_{0}: {1} {2}\nR_rect_{0}: 1 0 0 0 1 0 0 0 1\nP_rect_{0}: {3}\n", camera,
                        rig.intrinsics.width_px, rig.intrinsics.height_px, projection(rig, from_left_m));
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
  explicit KittiWriter(const vision::StereoRig& rig) : rig_(rig) {}

  std::vector<DatasetFile> frame_files(const FrameEvent& event, FrameTruth& truth) const override {
    const auto file = [&](const char* folder, const char* ending) {
      return fmt::format("{}/{:06}{}", folder, event.step, ending);
    };
    return {picture_file(file("image_2", "_10.png"), event.pair.left),
            picture_file(file("image_3", "_10.png"), event.pair.right),
            picture_file(file("disp_occ_0", "_10.png"), [&truth] { return disparity_of_all(truth); }),
            picture_file(file("disp_noc_0", "_10.png"), [&truth] { return disparity_of_seen(truth); }),
            text_file(file("calib_cam_to_cam", ".txt"), cam_to_cam(rig_)),
            text_file(file("calib", ".txt"), fmt::format("P2: {}\nP3: {}\n", projection(rig_, 0.0),
                                                         projection(rig_, rig_.baseline_m)))};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }

 private:
  vision::StereoRig rig_;
};

/// The line of the scenario, or the option, that the layout has no place for; empty where there is none.
std::string obstacle(const worlds::Scenario& scenario, const TruthRequest& truth) {
  const vision::StereoRig& rig = scenario.rig;
  if (!(rig.distortion == vision::Distortion{.pixel_aspect = rig.distortion.pixel_aspect}))
    return "rig.distortion";
  if (rig.distortion.pixel_aspect != 1.0) return "rig.pixel_aspect";
  if (!rig.right_turn_rad.isZero(0.0)) return "rig.right_turn_deg";
  if (calibration_yaml(scenario.believed_rig) != calibration_yaml(rig)) return "believed_rig";
  if (scenario.shutter.readout_s != 0.0) return "shutter.readout_s";
  if (scenario.shutter.right_delay_s != 0.0) return "shutter.right_delay_s";
  return truth.kinds.empty() ? "" : "--truth";
}

}  // namespace

void check_kitti_format(const worlds::Scenario& scenario, const TruthRequest& truth) {
  const std::string line = obstacle(scenario, truth);
  if (!line.empty())
    throw std::runtime_error(
        fmt::format("--format kitti: has no place for {}; it holds rectified pairs of one instant, their "
                    "disparity and one "
                    "calibration",
                    line));
}

std::unique_ptr<DatasetWriter> kitti_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiWriter>(drive.scenario.rig);
}

}  // namespace stereobench::harness
