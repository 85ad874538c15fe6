/// Messages of the Robot Operating System as values, from the encodings of ROS 1 and of ROS 2: the other way
/// round of harness/dataset/formats/container/ros_message.h. All throw std::runtime_error, one line, for
/// bytes that are no such message.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "harness/dataset/formats/container/ros_message.h"

namespace stereobench::harness {

struct ReadHeader {
  std::uint32_t sequence = 0;  ///< of ROS 1
  std::int64_t stamp_ns = 0;
  std::string frame;
};

/// What the bytes of any message with a header begin with.
ReadHeader read_ros_header(RosVersion version, std::string_view bytes);

/// sensor_msgs/Image of 8 bits a level. @return CV_8UC1 or CV_8UC3 (BGR); without transparency
cv::Mat read_ros_image(RosVersion version, std::string_view bytes);

/// sensor_msgs/CameraInfo.
struct ReadCameraInfo {
  ReadHeader header;
  int width_px = 0, height_px = 0;
  std::string model;
  std::vector<double> d;
  std::array<double, 9> k = {}, r = {};
  std::array<double, 12> p = {};
  bool is_of_whole_picture = true;  ///< without binning and region of interest

  /// Whether both are of one camera.
  bool is_same(const ReadCameraInfo& other) const {
    return width_px == other.width_px && height_px == other.height_px && model == other.model &&
           d == other.d && k == other.k && r == other.r && p == other.p &&
           is_of_whole_picture == other.is_of_whole_picture;
  }
};
ReadCameraInfo read_ros_camera_info(RosVersion version, std::string_view bytes);

/// A pose as it is told: the quaternion may have any length.
struct ReadPose {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();

  /// Its rotation is that of the quaternion, brought to length 1; none where that is 0.
  Eigen::Isometry3d rigid() const;
};

/// geometry_msgs/PoseStamped.
struct ReadStampedPose {
  ReadHeader header;
  ReadPose pose;
};
ReadStampedPose read_ros_pose(RosVersion version, std::string_view bytes);

/// tf2_msgs/TFMessage.
struct ReadTransform {
  ReadHeader header;
  std::string child_frame;
  ReadPose parent_from_child;
};
std::vector<ReadTransform> read_ros_transforms(RosVersion version, std::string_view bytes);

/// nav_msgs/Odometry: speeds in the child frame.
struct ReadOdometry {
  ReadHeader header;
  std::string child_frame;
  double v_mps = 0.0, lateral_mps = 0.0, w_radps = 0.0;
};
ReadOdometry read_ros_odometry(RosVersion version, std::string_view bytes);

/// geometry_msgs/Pose2D.
slam::Pose read_ros_planar_pose(RosVersion version, std::string_view bytes);

/// sensor_msgs/PointCloud2: fields of 64 bits, of which others may stand beside them.
/// @param columns the fields that are taken, in this order
/// @return a row a point
std::vector<std::vector<double>> read_ros_table(RosVersion version, std::string_view bytes,
                                                std::span<const std::string_view> columns);

}  // namespace stereobench::harness
