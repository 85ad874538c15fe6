#include "harness/dataset/formats/odometry/vslamlab_format.h"

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::Side;

class VslamlabWriter final : public DatasetWriter {
 public:
  explicit VslamlabWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    return {camera_file(path(pair.step(), Side::kLeft), pair, Side::kLeft),
            camera_file(path(pair.step(), Side::kRight), pair, Side::kRight)};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    std::string poses = "ts (ns),tx (m),ty (m),tz (m),qx,qy,qz,qw\n";
    const Eigen::Isometry3d robot_from_camera = vision::robot_from_camera(drive_.rig);
    for (const LogStep& step : log.steps) {
      const Eigen::Isometry3d pose = world_from_robot(step.truth.value()) * robot_from_camera;
      const Eigen::Vector3d& at = pose.translation();
      const Eigen::Quaterniond turn = unit_quaternion(pose.linear());
      poses += fmt::format("{},{},{},{},{},{},{},{}\n", kEpoch_ns + step.stamp_ns, at.x(), at.y(), at.z(),
                           turn.x(), turn.y(), turn.z(), turn.w());
    }
    return {text_file("rgb.csv", pairs_csv()), text_file("groundtruth.csv", poses),
            text_file("calibration.yaml", cameras_yaml())};
  }

 private:
  std::int64_t time_ns(std::size_t step) const { return kEpoch_ns + drive_.steps[step].stamp_ns; }
  std::string path(std::size_t step, Side side) const {
    return fmt::format("{}/{}.png", side == Side::kLeft ? "rgb_0" : "rgb_1", time_ns(step));
  }
  std::string pairs_csv() const {
    std::string csv = "ts_rgb_0 (ns),path_rgb_0,ts_rgb_1 (ns),path_rgb_1\n";
    for (const std::size_t step : steps_with_pictures(drive_))
      csv +=
          fmt::format("{0},{1},{0},{2}\n", time_ns(step), path(step, Side::kLeft), path(step, Side::kRight));
    return csv;
  }
  std::string cameras_yaml() const;

  const DatasetDrive& drive_;
};

std::string VslamlabWriter::cameras_yaml() const {
  const vision::Intrinsics& camera = drive_.rig.intrinsics;
  const vision::Distortion& lens = drive_.rig.distortion;
  const Eigen::Isometry3d left_from_robot = vision::robot_from_camera(drive_.rig).inverse();
  std::string yaml = "%YAML 1.2\n---\ncameras:\n";
  for (const Side side : kBothSides)
    yaml += fmt::format(
        "  - {{cam_name: {},\n     cam_type: rgb,\n     cam_model: pinhole,\n     distortion_type: radtan5,\n"
        "     focal_length: [{}, {}],\n     principal_point: [{}, {}],\n"
        "     distortion_coefficients: [{}, {}, {}, {}, {}],\n     image_dimension: [{}, {}],\n     fps: "
        "{},\n"
        "     T_BS: [{}]\n    }}\n",
        side == Side::kLeft ? "rgb_0" : "rgb_1", camera.focal_px, camera.focal_px * lens.pixel_aspect,
        camera.cx_px, camera.cy_px, lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, camera.width_px,
        camera.height_px, pairs_per_second(drive_),
        matrix_text(left_from_robot * vision::robot_from_camera(drive_.rig, side), 4, ", "));
  return yaml;
}

}  // namespace

void check_vslamlab_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"vslamlab", "pairs of one instant, and one calibration"};
  limits.require_believed(drive);
  limits.require_one_instant(drive);
  limits.require_in_time(drive);
}

std::unique_ptr<DatasetWriter> vslamlab_writer(const DatasetDrive& drive) {
  return std::make_unique<VslamlabWriter>(drive);
}

}  // namespace stereobench::harness
