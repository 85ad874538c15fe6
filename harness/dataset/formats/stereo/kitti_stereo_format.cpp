#include "harness/dataset/formats/stereo/kitti_stereo_format.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/rectified_pair.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using renderer::Correspondence;
using renderer::Occlusion;
using vision::Side;

/// What one of the layouts calls its folders; empty where it has none.
struct KittiLayout {
  const char* left;
  const char* right;
  const char* disparity_of_all;
  const char* disparity_of_seen;
  bool has_next_step = false;     ///< the disparity that points have then
  bool has_next_pair = false;     ///< the pictures that are taken then, and the flow to them
  bool has_grey_cameras = false;  ///< image_0/ and image_1/ too
};

constexpr KittiLayout k2015 = {.left = "image_2",
                               .right = "image_3",
                               .disparity_of_all = "disp_occ_0",
                               .disparity_of_seen = "disp_noc_0",
                               .has_next_step = true};
constexpr KittiLayout k2012 = {.left = "colored_0",
                               .right = "colored_1",
                               .disparity_of_all = "disp_occ",
                               .disparity_of_seen = "disp_noc",
                               .has_grey_cameras = true};
constexpr KittiLayout kSceneFlow = {.left = "image_2",
                                    .right = "image_3",
                                    .disparity_of_all = "disp_occ_0",
                                    .disparity_of_seen = "disp_noc_0",
                                    .has_next_step = true,
                                    .has_next_pair = true};

/// What KITTI says of the cameras of every pair: left and right in grey, left and right in colour. They had
/// no lens, and were not turned, before they were rectified.
std::string cam_to_cam(const vision::StereoRig& rig) {
  const vision::Intrinsics& camera = rig.intrinsics;
  constexpr const char* kNoTurn = "1 0 0 0 1 0 0 0 1";
  std::string text = "corner_dist: 0\n";
  for (int number = 0; number < 4; ++number) {
    const double from_left_m = number % 2 == 0 ? 0.0 : rig.baseline_m;
    text += fmt::format(
        "S_0{0}: {1} {2}\nK_0{0}: {3} 0 {4} 0 {3} {5} 0 0 1\nD_0{0}: 0 0 0 0 0\nR_0{0}: {6}\nT_0{0}: {7} 0 "
        "0\n"
        "S_rect_0{0}: {1} {2}\nR_rect_0{0}: {6}\nP_rect_0{0}: {8}\n",
        number, camera.width_px, camera.height_px, camera.focal_px, camera.cx_px, camera.cy_px, kNoTurn,
        from_left_m == 0.0 ? 0.0 : -from_left_m, projection_row(rig, from_left_m));
  }
  return text;
}

/// A picture of what is seen in the other one alone.
cv::Mat of_seen(cv::Mat picture, const Correspondence& found) {
  picture.setTo(0, found.occlusion != static_cast<std::uint8_t>(Occlusion::kSeen));
  return picture;
}

/// The disparity that each pixel's point has at the next step, px; +inf for none, and behind the camera.
cv::Mat disparity_at_next_step(const DatasetDrive& drive, DatasetPair& pair) {
  const vision::Intrinsics& camera = drive.rig.intrinsics;
  const auto left_at = [&](std::size_t step) {
    return world_from_robot(drive.steps[step].world_from_robot) * vision::robot_from_camera(drive.rig);
  };
  const Eigen::Isometry3d next_from_now = left_at(pair.step() + 1).inverse() * left_at(pair.step());
  const cv::Mat depth_m = pair.depth_m(Side::kLeft);
  cv::Mat disparity(depth_m.size(), CV_32FC1, cv::Scalar(std::numeric_limits<double>::infinity()));
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u) {
      const double z_m = depth_m.at<float>(v, u);
      if (z_m == std::numeric_limits<double>::infinity()) continue;
      const double then_m = (next_from_now * (z_m * vision::pixel_ray(camera, {u, v}))).z();
      if (then_m > 0.0)
        disparity.at<float>(v, u) = static_cast<float>(camera.focal_px * drive.rig.baseline_m / then_m);
    }
  return disparity;
}

class KittiStereoWriter final : public DatasetWriter {
 public:
  KittiStereoWriter(const DatasetDrive& drive, const KittiLayout& layout) : drive_(drive), layout_(layout) {}
  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override;
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }

 private:
  static std::string name(const char* folder, std::size_t step, const char* ending = "_10.png") {
    return fmt::format("{}/{:06}{}", folder, step, ending);
  }
  bool has_pictures(std::size_t step) const {
    return step < drive_.steps.size() && drive_.steps[step].pictures;
  }
  void add_pictures(DatasetPair& pair, std::size_t step, const char* ending,
                    std::vector<DatasetFile>& files) const;
  void add_next_step(DatasetPair& pair, std::vector<DatasetFile>& files) const;
  void add_calibration(std::size_t step, std::vector<DatasetFile>& files) const;

  const DatasetDrive& drive_;
  const KittiLayout& layout_;
};

void KittiStereoWriter::add_pictures(DatasetPair& pair, std::size_t step, const char* ending,
                                     std::vector<DatasetFile>& files) const {
  for (const Side side : kBothSides)
    files.push_back(
        camera_file(name(side == Side::kLeft ? layout_.left : layout_.right, step, ending), pair, side));
}

void KittiStereoWriter::add_next_step(DatasetPair& pair, std::vector<DatasetFile>& files) const {
  const std::size_t step = pair.step();
  if (step + 1 == drive_.steps.size()) {
    const vision::Intrinsics& camera = drive_.rig.intrinsics;
    const cv::Mat none = cv::Mat::zeros(camera.height_px, camera.width_px, CV_16UC1);
    files.push_back(picture_file(name("disp_occ_1", step), none));
    files.push_back(picture_file(name("disp_noc_1", step), none));
    return;
  }
  const auto disparity = [this, &pair] { return kitti_disparity(disparity_at_next_step(drive_, pair)); };
  files.push_back(picture_file(name("disp_occ_1", step), disparity));
  files.push_back(picture_file(name("disp_noc_1", step), [disparity, &pair] {
    return of_seen(disparity(), pair.to_next_step(Side::kLeft));
  }));
}

void KittiStereoWriter::add_calibration(std::size_t step, std::vector<DatasetFile>& files) const {
  const vision::StereoRig& rig = drive_.rig;
  files.push_back(
      text_file(name("calib", step, ".txt"), kitti_projections(rig, layout_.has_grey_cameras ? 0 : 2)));
  if (!layout_.has_grey_cameras)
    files.push_back(text_file(name("calib_cam_to_cam", step, ".txt"), cam_to_cam(rig)));
}

std::vector<DatasetFile> KittiStereoWriter::frame_files(DatasetPair& pair) const {
  const std::size_t step = pair.step();
  std::vector<DatasetFile> files;
  if (layout_.has_next_pair) {
    if (step > 0 && has_pictures(step - 1)) add_pictures(pair, step - 1, "_11.png", files);
    if (!has_pictures(step + 1)) return files;
    const auto flow = [&pair] { return kitti_shift(pair.to_next_step(Side::kLeft)); };
    files.push_back(picture_file(name("flow_occ", step), flow));
    files.push_back(picture_file(name("flow_noc", step),
                                 [flow, &pair] { return of_seen(flow(), pair.to_next_step(Side::kLeft)); }));
  }
  add_pictures(pair, step, "_10.png", files);
  if (layout_.has_grey_cameras)
    for (const Side side : kBothSides)
      files.push_back(picture_file(name(side == Side::kLeft ? "image_0" : "image_1", step),
                                   [side, &pair] { return grey_of(pair.picture(side)); }));
  const auto disparity = [&pair] { return kitti_disparity(disparity_of(pair, Side::kLeft)); };
  files.push_back(picture_file(name(layout_.disparity_of_all, step), disparity));
  files.push_back(picture_file(name(layout_.disparity_of_seen, step), [disparity, &pair] {
    return of_seen(disparity(), pair.to_other_camera(Side::kLeft));
  }));
  if (layout_.has_next_step) add_next_step(pair, files);
  add_calibration(step, files);
  return files;
}

void check_pairs_and_next_step(const DatasetDrive& drive, const FormatLimits& limits) {
  limits.require_pairs(drive);
  limits.require_in_time(drive);
  limits.require_all_frames(drive);
}

}  // namespace

void check_kitti_stereo_format(const DatasetDrive& drive) {
  check_pairs_and_next_step(
      drive,
      {"kitti-stereo", "rectified pairs of one instant, and their disparity now and at the next step"});
}

void check_kitti_stereo_2012_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"kitti-stereo-2012", "rectified pairs of one instant, and their disparity"};
  limits.require_pairs(drive);
}

void check_kitti_scene_flow_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"kitti-scene-flow",
                               "rectified pairs of one instant, and where their points are at the next step"};
  check_pairs_and_next_step(drive, limits);
  const std::vector<std::size_t> taken = steps_with_pictures(drive);
  const auto follows = [](std::size_t step, std::size_t next) { return next == step + 1; };
  if (std::ranges::adjacent_find(taken, follows) == taken.end())
    limits.refuse("--frames without two in a row");
}

std::unique_ptr<DatasetWriter> kitti_stereo_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiStereoWriter>(drive, k2015);
}

std::unique_ptr<DatasetWriter> kitti_stereo_2012_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiStereoWriter>(drive, k2012);
}

std::unique_ptr<DatasetWriter> kitti_scene_flow_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiStereoWriter>(drive, kSceneFlow);
}

}  // namespace stereobench::harness
