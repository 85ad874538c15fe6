#include "harness/dataset/calibration_file.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <Eigen/Core>
#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "slam/elementary.h"
#include "vision/distortion.h"
#include "vision/rig.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kRounding = 1e-12;  // of a rotation that went through a file

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

double number(const fs::path& file, const cv::FileStorage& storage, const char* key) {
  const cv::FileNode node = storage[key];
  if (!node.isReal() && !node.isInt()) refuse(file, fmt::format("{}: expected a number", key));
  return node.real();
}

/// A matrix of doubles; empty where the key is left out.
cv::Mat matrix(const fs::path& file, const cv::FileStorage& storage, const char* key, const cv::Size& size) {
  const cv::FileNode node = storage[key];
  if (node.empty()) return {};
  const cv::Mat matrix = node.isMap() ? node.mat() : cv::Mat();
  if (matrix.size() != size || matrix.type() != CV_64F)
    refuse(file, fmt::format("{}: expected a matrix of {} x {} doubles", key, size.height, size.width));
  return matrix;
}

Eigen::Matrix3d rotation_of(const cv::Mat& transform) {
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation(row, column) = transform.at<double>(row, column);
  return rotation;
}

/// The angles of R = Rx Ry Rz.
Eigen::Vector3d angles_of(const Eigen::Matrix3d& rotation) {
  Eigen::Vector3d angles(slam::arc_tangent(-rotation(1, 2), rotation(2, 2)),
                         slam::arc_tangent(rotation(0, 2), rotation.block<2, 1>(1, 2).norm()),
                         slam::arc_tangent(-rotation(0, 1), rotation(0, 0)));
  for (double& angle : angles)
    if (std::abs(angle) < kRounding) angle = 0.0;
  return angles;
}

vision::StereoRig rig_in(const fs::path& file, const cv::FileStorage& storage) {
  const cv::Mat k = matrix(file, storage, "K", {3, 3});
  if (k.empty()) refuse(file, "K: this key is missing");
  if (std::abs(k.at<double>(0, 0) - k.at<double>(1, 1)) > 1e-9 * std::abs(k.at<double>(0, 0)))
    refuse(file, "K: expected the same focal length across and down");
  vision::StereoRig rig;
  rig.camera = {static_cast<int>(number(file, storage, "image_width")),
                static_cast<int>(number(file, storage, "image_height")), k.at<double>(0, 0),
                k.at<double>(0, 2), k.at<double>(1, 2)};
  rig.baseline_m = number(file, storage, "baseline_m");
  rig.height_m = 0.0;
  const cv::Mat d = matrix(file, storage, "D", {5, 1});
  if (!d.empty()) {
    rig.distortion = {.k1 = d.at<double>(0),
                      .k2 = d.at<double>(1),
                      .p1 = d.at<double>(2),
                      .p2 = d.at<double>(3),
                      .k3 = d.at<double>(4)};
  }
  if (!vision::directions_seen(rig.distortion, rig.camera))
    refuse(file, "D: expected a lens that does not fold its picture");
  const cv::Mat left = matrix(file, storage, "robot_from_left_camera", {4, 4});
  const cv::Mat right = matrix(file, storage, "robot_from_right_camera", {4, 4});
  if (left.empty()) return rig;
  rig.height_m = left.at<double>(2, 3);
  rig.pitch_down_rad = slam::arc_tangent(-left.at<double>(2, 2), left.at<double>(0, 2));
  if (!right.empty()) rig.right_turn_rad = angles_of(rotation_of(left).transpose() * rotation_of(right));
  return rig;
}

}  // namespace

vision::StereoRig read_calibration(const fs::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  if (!fs::exists(file)) refuse(file, "no such file");
  if (content.str().empty()) refuse(file, "expected a calibration (the file is empty, or a folder)");
  try {
    const cv::FileStorage storage(content.str(), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    const vision::StereoRig rig = rig_in(file, storage);
    if (!vision::is_usable(rig)) refuse(file, "expected finite numbers, positive sizes and baseline");
    return rig;
  } catch (const cv::Exception& error) {
    refuse(file, "expected a calibration as an OpenCV YAML file");
  }
}

}  // namespace stereobench::harness
