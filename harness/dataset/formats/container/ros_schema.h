/// The definitions of messages of the Robot Operating System, as recordings carry them for their readers.
#pragma once

#include <string>

#include "harness/dataset/formats/container/ros_message.h"

namespace stereobench::harness {

/// The messages that are written (ros_message.h).
enum class RosType { kImage, kCameraInfo, kOdometry, kPose, kPlanarPose, kTransforms, kSpheres, kTable };

struct RosSchema {
  std::string name;        ///< "sensor_msgs/Image", of ROS 2 "sensor_msgs/msg/Image"
  std::string definition;  ///< its fields, and the types that they are made of, each under "MSG: NAME"
  std::string md5;         ///< of the definition, as ROS 1 counts it; ROS 2 has none
};

/// ROS 2's are those of Humble.
RosSchema ros_schema(RosType type, RosVersion version);

}  // namespace stereobench::harness
