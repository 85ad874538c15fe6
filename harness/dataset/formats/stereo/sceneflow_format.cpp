#include "harness/dataset/formats/stereo/sceneflow_format.h"

#include <limits>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/rectified_pair.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "harness/io/calibration_file.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// Camera axes as Blender has them: y up, z backward.
Eigen::Isometry3d in_axes_of_blender(Eigen::Isometry3d world_from_camera) {
  world_from_camera.linear().rightCols<2>() *= -1.0;
  return world_from_camera;
}

/// Disparity, 0 for nothing: what is infinitely far. Readers have no mask for it.
cv::Mat disparity_or_zero(DatasetPair& pair, Side side) {
  cv::Mat disparity = disparity_of(pair, side);
  disparity.setTo(0.0, disparity == std::numeric_limits<float>::infinity());
  return disparity;
}

/// Flow with nothing in its third channel.
cv::Mat flow_picture(const renderer::Correspondence& found) {
  cv::Mat picture = exact_shift(found);
  cv::insertChannel(cv::Mat::zeros(picture.size(), CV_32FC1), picture, 0);
  return picture;
}

class SceneflowWriter final : public DatasetWriter {
 public:
  explicit SceneflowWriter(const DatasetDrive& drive)
      : drive_(drive), scene_(fmt::format("{}_{}", drive.name, drive.seed)) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) {
      const char* const name = side == Side::kLeft ? "left" : "right";
      const std::size_t step = pair.step();
      files.push_back(
          camera_file(fmt::format("frames_cleanpass/{}/{}/{:04}.png", scene_, name, step), pair, side));
      files.push_back(picture_file(fmt::format("disparity/{}/{}/{:04}.pfm", scene_, name, step),
                                   [side, &pair] { return disparity_or_zero(pair, side); }));
      if (step + 1 == drive_.steps.size()) continue;
      files.push_back(
          picture_file(fmt::format("optical_flow/{}/into_future/{}/OpticalFlowIntoFuture_{:04}_{}.pfm",
                                   scene_, name, step, side == Side::kLeft ? "L" : "R"),
                       [side, &pair] { return flow_picture(pair.to_next_step(side)); }));
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override {
    std::string text;
    for (std::size_t step = 0; step < drive_.steps.size(); ++step) {
      if (!drive_.steps[step].pictures) continue;
      text += fmt::format("Frame {}\n", step);
      for (const Side side : kBothSides)
        text += fmt::format("{} {}\n", side == Side::kLeft ? "L" : "R",
                            matrix_text(in_axes_of_blender(world_from_camera(drive_, step, side)), 4, " "));
      text += "\n";
    }
    const std::string folder = fmt::format("camera_data/{}/", scene_);
    return {text_file(folder + "camera_data.txt", text),
            text_file(folder + "calibration.yaml", calibration_yaml(drive_.rig))};
  }

 private:
  const DatasetDrive& drive_;
  std::string scene_;
};

}  // namespace

void check_sceneflow_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"sceneflow", "rectified pairs of one instant, their disparity and their flow"};
  limits.require_pairs(drive);
  limits.require_in_time(drive);
  limits.require_all_frames(drive);
}

std::unique_ptr<DatasetWriter> sceneflow_writer(const DatasetDrive& drive) {
  return std::make_unique<SceneflowWriter>(drive);
}

}  // namespace stereobench::harness
