#include "harness/dataset/camera_pose.h"

#include <fmt/format.h>

#include "harness/logs/measurement_log_writer.h"
#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

Eigen::Isometry3d world_from_robot(const slam::Pose& pose) {
  const slam::SineCosine turn = slam::sine_cosine(pose.heading_rad);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear().topLeftCorner<2, 2>() << turn.cosine, -turn.sine, turn.sine, turn.cosine;
  place.translation() << pose.x_m, pose.y_m, 0.0;
  return place;
}

Eigen::Isometry3d world_from_camera(const DatasetDrive& drive, std::size_t step, vision::Side side) {
  const TakenPictures& taken = drive.steps[step].pictures.value();
  const slam::Pose& pose =
      side == vision::Side::kLeft ? taken.world_from_robot : taken.world_from_robot_right;
  return world_from_robot(pose) * vision::robot_from_camera(drive.rig, side);
}

Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond turn(rotation);
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  return turn;
}

std::string tum_line(std::int64_t stamp_ns, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& at = pose.translation();
  const Eigen::Quaterniond turn = unit_quaternion(pose.linear());
  return fmt::format("{} {} {} {} {} {} {} {}\n", seconds_of(stamp_ns), at.x(), at.y(), at.z(), turn.x(),
                     turn.y(), turn.z(), turn.w());
}

std::string matrix_text(const Eigen::Isometry3d& pose, int rows, const char* separator) {
  std::string text;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < 4; ++column)
      text += fmt::format("{}{}", text.empty() ? "" : separator, pose.matrix()(row, column));
  return text;
}

}  // namespace stereobench::harness
