#include "harness/io/calibration_file.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include <Eigen/Core>
#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "harness/io/text_file.h"
#include "harness/json/json_line.h"
#include "slam/math/elementary.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"
#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kRounding = 1e-12;   // of a rotation that went through a file
constexpr double kSquare = 1e-9;      // pixels that are as square as this were meant to be
constexpr double kLeastAspect = 0.5;  // of pixels; a rectified picture is up to twice as large

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// The number that a node holds, infinities and NaN included; empty where it holds none.
std::optional<double> number_in(const YAML::Node& node) {
  double value = 0.0;
  if (!node.IsDefined() || !node.IsScalar()) return std::nullopt;
  if (node.Scalar() == ".Nan") return std::nan("");  // OpenCV's spelling
  return YAML::convert<double>::decode(node, value) ? std::optional(value) : std::nullopt;
}

double number(const fs::path& file, const YAML::Node& storage, const char* key) {
  const std::optional<double> value = number_in(storage[key]);
  if (!value) refuse(file, fmt::format("{}: expected a number", key));
  return *value;
}

int pixels(const fs::path& file, const YAML::Node& storage, const char* key) {
  constexpr double kMost = 65536.0;
  const double value = number(file, storage, key);
  if (!(value >= 1.0 && value <= kMost))
    refuse(file, fmt::format("{}: expected positive sizes, at most {}", key, kMost));
  return static_cast<int>(value);
}

/// The numbers of a matrix, row by row; empty where the node is no matrix of this size.
std::optional<cv::Mat> matrix_in(const YAML::Node& node, const cv::Size& size) {
  if (!node.IsMap() || number_in(node["rows"]) != size.height || number_in(node["cols"]) != size.width)
    return std::nullopt;
  const YAML::Node data = node["data"];
  if (!data.IsDefined() || !data.IsSequence() || data.size() != static_cast<std::size_t>(size.area()))
    return std::nullopt;
  cv::Mat matrix(size, CV_64F);
  for (int i = 0; i < size.area(); ++i) {
    const std::optional<double> entry = number_in(data[static_cast<std::size_t>(i)]);
    if (!entry) return std::nullopt;
    matrix.at<double>(i / size.width, i % size.width) = *entry;
  }
  return matrix;
}

/// A matrix of doubles; empty where the key is left out.
cv::Mat matrix(const fs::path& file, const YAML::Node& storage, const char* key, const cv::Size& size) {
  const YAML::Node node = storage[key];
  if (!node.IsDefined() || node.IsNull()) return {};
  const std::optional<cv::Mat> matrix = matrix_in(node, size);
  if (!matrix)
    refuse(file, fmt::format("{}: expected a matrix of {} x {} doubles", key, size.height, size.width));
  return *matrix;
}

Eigen::Matrix3d rotation_of(const cv::Mat& transform) {
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation(row, column) = transform.at<double>(row, column);
  return rotation;
}

/// The camera of a K, with pictures of a size that is yet to be said.
vision::Intrinsics intrinsics_in(const fs::path& file, const YAML::Node& storage) {
  const cv::Mat k = matrix(file, storage, "K", {3, 3});
  if (k.empty()) refuse(file, "K: this key is missing");
  return {0, 0, k.at<double>(0, 0), k.at<double>(0, 2), k.at<double>(1, 2)};
}

/// A K's focal length down over that across: 1 where they differ by rounding.
double aspect_in(const fs::path& file, const YAML::Node& storage) {
  const cv::Mat k = matrix(file, storage, "K", {3, 3});
  const double aspect = k.at<double>(1, 1) / k.at<double>(0, 0);
  if (!(aspect >= kLeastAspect && aspect <= 1.0 / kLeastAspect))
    refuse(file,
           fmt::format("K: expected focal lengths across and down that differ by a factor of {} at most",
                       1.0 / kLeastAspect));
  return std::abs(aspect - 1.0) <= kSquare ? 1.0 : aspect;
}

/// What a K and a D say of a lens and its pixels.
vision::Distortion lens_in(const fs::path& file, const YAML::Node& storage) {
  vision::Distortion lens{.pixel_aspect = aspect_in(file, storage)};
  const cv::Mat d = matrix(file, storage, "D", {5, 1});
  if (d.empty()) return lens;
  lens.k1 = d.at<double>(0);
  lens.k2 = d.at<double>(1);
  lens.p1 = d.at<double>(2);
  lens.p2 = d.at<double>(3);
  lens.k3 = d.at<double>(4);
  return lens;
}

vision::CameraModel camera_in(const fs::path& file, const YAML::Node& storage,
                              const vision::Intrinsics& size) {
  if (!storage.IsDefined() || !storage.IsMap())
    refuse(file, "left_eye, right_eye: expected both, each with K, D, rectified_from_eye");
  vision::CameraModel camera{.intrinsics = intrinsics_in(file, storage), .lens = lens_in(file, storage)};
  camera.intrinsics.width_px = size.width_px;
  camera.intrinsics.height_px = size.height_px;
  const cv::Mat turn = matrix(file, storage, "rectified_from_eye", {3, 3});
  if (!turn.empty()) camera.rectified_from_camera = rotation_of(turn);
  if (!vision::is_usable(camera))
    refuse(file, "left_eye, right_eye: expected cameras that can be computed with");
  return camera;
}

vision::StereoRig rig_in(const fs::path& file, const YAML::Node& storage) {
  vision::StereoRig rig;
  rig.intrinsics = intrinsics_in(file, storage);
  rig.intrinsics.width_px = pixels(file, storage, "image_width");
  rig.intrinsics.height_px = pixels(file, storage, "image_height");
  rig.baseline_m = number(file, storage, "baseline_m");
  rig.height_m = 0.0;
  rig.distortion = lens_in(file, storage);
  if (!vision::directions_seen(rig.distortion, rig.intrinsics))
    refuse(file, "D: expected a lens that does not fold its picture");
  const cv::Mat left = matrix(file, storage, "robot_from_left_camera", {4, 4});
  const cv::Mat right = matrix(file, storage, "robot_from_right_camera", {4, 4});
  if (left.empty()) return rig;
  rig.height_m = left.at<double>(2, 3);
  rig.pitch_down_rad = slam::arc_tangent(-left.at<double>(2, 2), left.at<double>(0, 2));
  if (!right.empty()) rig.right_turn_rad = turn_angles(rotation_of(left).transpose() * rotation_of(right));
  return rig;
}

/// The map of keys that OpenCV's YAML files are.
YAML::Node document_in(const std::string& text, const fs::path& name) {
  try {
    const std::vector<YAML::Node> documents = worlds::parse_yaml(text);
    if (documents.size() == 1 && documents.front().IsMap()) return documents.front();
  } catch (const YAML::Exception& error) {
    refuse(name, fmt::format("expected a calibration as an OpenCV YAML file (line {}: {})",
                             error.mark.line + 1, excerpt(error.msg)));
  }
  refuse(name, "expected a calibration as an OpenCV YAML file");
}

cv::Mat camera_matrix(const vision::Intrinsics& c, const vision::Distortion& lens) {
  const double down_px = c.focal_px * lens.pixel_aspect;
  return (cv::Mat_<double>(3, 3) << c.focal_px, 0, c.cx_px, 0, down_px, c.cy_px, 0, 0, 1);
}

/// From the left camera's frame to a camera's pixels, K [R | t].
cv::Mat projection(const vision::StereoRig& rig, vision::Side side) {
  const Eigen::Vector3d origin = vision::camera_point(rig, Eigen::Vector3d::Zero(), side);
  cv::Mat camera_from_left(3, 4, CV_64F);
  for (int column = 0; column < 4; ++column) {
    const Eigen::Vector3d axis =
        column < 3 ? Eigen::Vector3d(vision::camera_point(rig, Eigen::Vector3d::Unit(column), side) - origin)
                   : origin;
    for (int row = 0; row < 3; ++row) camera_from_left.at<double>(row, column) = axis[row];
  }
  return camera_matrix(rig.intrinsics, rig.distortion) * camera_from_left;
}

template <typename Matrix>
cv::Mat matrix_of(const Matrix& values) {
  cv::Mat matrix(static_cast<int>(values.rows()), static_cast<int>(values.cols()), CV_64F);
  for (int row = 0; row < matrix.rows; ++row)
    for (int column = 0; column < matrix.cols; ++column) matrix.at<double>(row, column) = values(row, column);
  return matrix;
}

cv::Mat coefficients(const vision::Distortion& lens) {
  return cv::Mat(cv::Matx<double, 1, 5>(lens.k1, lens.k2, lens.p1, lens.p2, lens.k3));
}

void write_camera(cv::FileStorage& file, const char* name, const vision::CameraModel& camera) {
  file << name << "{";
  file << "K" << camera_matrix(camera.intrinsics, camera.lens) << "D" << coefficients(camera.lens);
  file << "rectified_from_eye" << matrix_of(camera.rectified_from_camera) << "}";
}

}  // namespace

std::string calibration_yaml(const vision::StereoRig& rig, const std::optional<vision::CameraPair>& cameras) {
  cv::FileStorage file(".yaml",
                       cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  file << "image_width" << rig.intrinsics.width_px << "image_height" << rig.intrinsics.height_px;
  file << "K" << camera_matrix(rig.intrinsics, rig.distortion);
  file << "D" << coefficients(rig.distortion);
  file << "P1" << projection(rig, vision::Side::kLeft) << "P2" << projection(rig, vision::Side::kRight);
  file << "baseline_m" << rig.baseline_m;
  file << "robot_from_left_camera" << matrix_of(vision::robot_from_camera(rig, vision::Side::kLeft).matrix());
  file << "robot_from_right_camera"
       << matrix_of(vision::robot_from_camera(rig, vision::Side::kRight).matrix());
  if (cameras) {
    write_camera(file, "left_eye", cameras->front());
    write_camera(file, "right_eye", cameras->back());
  }
  return file.releaseAndGetString();
}

Eigen::Vector3d turn_angles(const Eigen::Matrix3d& rotation) {
  Eigen::Vector3d angles(slam::arc_tangent(-rotation(1, 2), rotation(2, 2)),
                         slam::arc_tangent(rotation(0, 2), rotation.block<2, 1>(1, 2).norm()),
                         slam::arc_tangent(-rotation(0, 1), rotation(0, 0)));
  for (double& angle : angles)
    if (std::abs(angle) < kRounding) angle = 0.0;
  return angles;
}

RigCalibration parse_calibration(const std::string& text, const fs::path& name) {
  const YAML::Node root = document_in(text, name);
  RigCalibration calibration{.rig = rig_in(name, root)};
  if (!vision::is_usable(calibration.rig))
    refuse(name, "expected finite numbers, positive sizes and baseline");
  if (!root["left_eye"].IsDefined() && !root["right_eye"].IsDefined()) return calibration;
  calibration.cameras = {camera_in(name, root["left_eye"], calibration.rig.intrinsics),
                         camera_in(name, root["right_eye"], calibration.rig.intrinsics)};
  return calibration;
}

RigCalibration read_rig_calibration(const fs::path& file) {
  return parse_calibration(read_text(file), file);
}

vision::StereoRig read_calibration(const fs::path& file) {
  const RigCalibration calibration = read_rig_calibration(file);
  if (calibration.cameras) refuse(file, "expected one camera twice (it has left_eye and right_eye)");
  return calibration.rig;
}

}  // namespace stereobench::harness
