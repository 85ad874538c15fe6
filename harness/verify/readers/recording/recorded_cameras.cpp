#include "harness/verify/readers/recording/recorded_cameras.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/json/json_line.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Eigen::Isometry3d;

bool is_without_lens(const ReadCameraInfo& info) {
  return std::ranges::all_of(info.d, [](double coefficient) { return coefficient == 0.0; });
}

bool is_turned(const ReadCameraInfo& info) {
  return !Eigen::Map<const Matrix3>(info.r.data()).isIdentity(1e-12);
}

/// What camera_info says of one camera. What it says twice is P against K, of pictures without a lens.
ViewCamera lens_of(const ReadCameraInfo& info) {
  constexpr double kSame_px = 1e-3;
  constexpr std::size_t kMostCoefficients = 5;
  const double fx = info.k[0], fy = info.k[4];
  if (!(fx >= kLeastPositive) || !(fy >= kLeastPositive))
    throw std::runtime_error("expected positive focal lengths in K");
  if (!info.is_of_whole_picture)
    throw std::runtime_error("expected whole pictures (got binning or a region)");
  const bool is_plumb_bob = info.model == "plumb_bob" && info.d.size() <= kMostCoefficients;
  if (!is_plumb_bob && !is_without_lens(info))
    throw std::runtime_error(
        fmt::format("distortion_model: expected plumb_bob with at most 5 coefficients (got "
                    "{} with {})",
                    info.model, info.d.size()));
  const std::array said = {info.p[0], info.p[2], info.p[5], info.p[6]},
                   known = {fx, info.k[2], fy, info.k[5]};
  for (std::size_t i = 0; i < said.size(); ++i)
    if (is_without_lens(info) && !is_turned(info) && info.p[0] != 0.0 &&
        std::abs(said[i] - known[i]) > kSame_px)
      throw std::runtime_error(fmt::format(
          "P has {:.9g} px where K has {:.9g} px, and there is no lens between", said[i], known[i]));
  std::vector<double> d = info.d;
  d.resize(kMostCoefficients, 0.0);
  ViewCamera camera;
  camera.pinhole = {info.width_px, info.height_px, fx, info.k[2], info.k[5]};
  camera.lens = {.k1 = d[0], .k2 = d[1], .p1 = d[2], .p2 = d[3], .k3 = d[4], .pixel_aspect = fy / fx};
  return camera;
}

/// The camera_info of a camera; one that changes is a fault.
std::optional<ReadCameraInfo> info_of(OpenRecording& from, const std::string& topic) {
  const auto infos = read_messages(from, topic, "sensor_msgs/CameraInfo", read_ros_camera_info);
  if (infos.empty()) return std::nullopt;
  for (std::size_t i = 1; i < infos.size(); ++i)
    if (!infos[i].value.is_same(infos.front().value)) {
      from.faults.push_back({from.place_of(topic), fmt::format("{}", infos[i].value.header.stamp_ns),
                             "the camera is another one than in the first message"});
      break;
    }
  return infos.front().value;
}

/// Where frames are in others, by transforms that hold all the time.
class FixedFrames {
 public:
  explicit FixedFrames(OpenRecording& from) {
    for (const auto& [message, transforms] :
         read_messages(from, "/tf_static", "tf2_msgs/TFMessage", read_ros_transforms))
      for (const ReadTransform& transform : transforms) above_[named(transform.child_frame)] = transform;
  }
  /// @return empty where none leads there
  std::optional<Isometry3d> place_in(const std::string& body, const std::string& frame) const {
    Isometry3d place = Isometry3d::Identity();
    std::string at = named(frame);
    for (std::size_t steps = 0; at != named(body); ++steps) {
      const auto above = above_.find(at);
      if (above == above_.end() || steps > above_.size()) return std::nullopt;
      place = above->second.parent_from_child.rigid() * place;
      at = named(above->second.header.frame);
    }
    return place;
  }

 private:
  /// Old frames begin with a slash.
  static std::string named(const std::string& frame) {
    return frame.starts_with('/') ? frame.substr(1) : frame;
  }

  std::map<std::string, ReadTransform> above_;  ///< by the child's name
};

/// 0 where P has none.
double baseline_in(const ReadCameraInfo& right) {
  return right.p[0] >= kLeastPositive ? -right.p[3] / right.p[0] : 0.0;
}

/// Where the right camera is in the left one, by how both are turned to be rectified.
Isometry3d left_from_right(const std::array<ReadCameraInfo, 2>& infos) {
  const Matrix3 left = Eigen::Map<const Matrix3>(infos[0].r.data()),
                right = Eigen::Map<const Matrix3>(infos[1].r.data());
  Isometry3d place = Isometry3d::Identity();
  place.linear() = left.transpose() * right;
  place.translation() = left.transpose() * Eigen::Vector3d(baseline_in(infos[1]), 0.0, 0.0);
  return place;
}

void compare_baselines(OpenRecording& from, const RecordedCameras& found, const ReadCameraInfo& right) {
  constexpr double kSame = 1e-3;
  const double said_m = baseline_in(right);
  const double there_m =
      (found.cameras[1].body_from_camera.translation() - found.cameras[0].body_from_camera.translation())
          .norm();
  if (said_m != 0.0 && std::abs(said_m - there_m) > kSame * there_m)
    from.faults.push_back(
        {from.place_of(from.cameras[1] + "camera_info"), "",
         fmt::format("the baseline is {:.6g} m by P, and {:.6g} m by /tf_static", said_m, there_m)});
}

}  // namespace

std::optional<RecordedCameras> recorded_cameras(OpenRecording& from, const std::array<std::string, 2>& frames,
                                                std::vector<std::string>& cannot) {
  std::array<ReadCameraInfo, 2> infos;
  RecordedCameras found;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string topic = from.cameras[side] + "camera_info";
    const auto info = info_of(from, topic);
    if (!info || info->k[0] == 0.0) {
      cannot.push_back(fmt::format("cameras and poses against pictures: {} says nothing of the camera",
                                   worlds::excerpt(topic)));
      return std::nullopt;
    }
    infos[side] = *info;
    try {
      found.cameras[side] = lens_of(*info);
    } catch (const std::runtime_error& error) {
      from.faults.push_back({from.place_of(topic), "", error.what()});
      return std::nullopt;
    }
  }
  const FixedFrames transforms(from);
  const auto left = transforms.place_in(from.body, frames[0]),
             right = transforms.place_in(from.body, frames[1]);
  found.are_on_body = left && right;
  if (!found.are_on_body && !(baseline_in(infos[1]) > 0.0)) {
    cannot.push_back(
        fmt::format("cameras and poses against pictures: no transform leads from {} to the cameras, and "
                    "P of the right one has no baseline",
                    worlds::excerpt(from.body)));
    return std::nullopt;
  }
  found.cameras[0].body_from_camera = found.are_on_body ? *left : Isometry3d::Identity();
  found.cameras[1].body_from_camera = found.are_on_body ? *right : left_from_right(infos);
  if (found.are_on_body) compare_baselines(from, found, infos[1]);
  return found;
}

}  // namespace stereobench::harness
