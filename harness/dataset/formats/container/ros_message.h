/// Messages of the Robot Operating System as bytes, in the encodings of ROS 1 and of ROS 2.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "slam/types.h"
#include "vision/types.h"

namespace stereobench::harness {

/// kOne packs values as they come; kTwo is CDR (OMG DDSI-RTPS 9.4 and CORBA 3 part 2, 9.3), little endian: a
/// value begins at a multiple of its size.
enum class RosVersion { kOne, kTwo };

/// Numbers of 32 and of 64 bits, as a field of sensor_msgs/PointCloud2 says them.
inline constexpr std::uint8_t kRosFloat32 = 7, kRosFloat64 = 8;

/// When a message's values hold, and in which frame.
struct RosHeader {
  std::uint32_t sequence = 0;  ///< ROS 1 alone has it
  std::int64_t stamp_ns = 0;   ///< >= 0
  std::string_view frame;
};

/// Where a frame is in that of the header.
struct RosTransform {
  RosHeader header;
  std::string_view child_frame;
  Eigen::Isometry3d parent_from_child;
};

/// A sphere to be shown. It is named by `name` and `id` together.
struct RosSphere {
  std::string name;
  int id = 0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  Eigen::Vector3d rgb = Eigen::Vector3d::Ones();  ///< in [0, 1]
};

/// sensor_msgs/Image, bgr8. @param picture CV_8UC3
std::string ros_image(RosVersion version, const RosHeader& header, const cv::Mat& picture);

/// sensor_msgs/CameraInfo of a rig whose right camera is not turned: K and D are the camera's, R is the
/// identity, and P the projection of pictures without distortion; that of the right camera has P[3] = -f B.
std::string ros_camera_info(RosVersion version, const RosHeader& header, const vision::StereoRig& rig,
                            vision::Side side);

/// nav_msgs/Odometry; its covariances are 0, which stands for none.
/// @param v_mps, w_radps speeds in the child frame: forward, and counter-clockwise
std::string ros_odometry(RosVersion version, const RosTransform& pose, double v_mps, double w_radps);

/// geometry_msgs/PoseStamped.
std::string ros_pose(RosVersion version, const RosHeader& header, const Eigen::Isometry3d& pose);

/// geometry_msgs/Pose2D, which has no header.
std::string ros_planar_pose(RosVersion version, const slam::Pose& pose);

/// tf2_msgs/TFMessage.
std::string ros_transforms(RosVersion version, std::span<const RosTransform> transforms);

/// visualization_msgs/MarkerArray.
/// @param lifetime_ns for how long they are shown; 0: for ever
std::string ros_spheres(RosVersion version, const RosHeader& header, std::span<const RosSphere> spheres,
                        std::int64_t lifetime_ns);

/// A point on the floor that has numbers.
struct RosPoint {
  Eigen::Vector2d place_m;  ///< in the header's frame
  std::vector<double> numbers;
};

/// sensor_msgs/PointCloud2: x, y and z of 32 bits, which is what viewers of clouds look for, then the numbers
/// of 64.
/// @param columns names of the numbers
/// @param points of as many numbers
std::string ros_points(RosVersion version, const RosHeader& header, std::span<const std::string_view> columns,
                       std::span<const RosPoint> points);

}  // namespace stereobench::harness
