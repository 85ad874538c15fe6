/// Recordings of the Robot Operating System: `rosbag` of ROS 1, `mcap` of ROS 2.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what check_ros_drive (ros_drive.h) refuses.
void check_rosbag_format(const DatasetDrive& drive);
void check_mcap_format(const DatasetDrive& drive);

/// Writes NAME_SEED.bag, a bag of version 2.0 without compression, with the messages of ros_drive.h:
///
///     /stereo/left/image_raw, /stereo/left/camera_info    pictures (bgr8) and their camera; right as well
///     /odom                         the measured odometry, summed up from the true start
///     /ground_truth/pose, /tf       the true pose
///     /tf_static                    the cameras on the robot
///     /detections                   what was measured, as spheres around the robot
///     /ground_truth/balls           the balls that one of the pictures shows
std::unique_ptr<DatasetWriter> rosbag_writer(const DatasetDrive& drive);

/// Writes NAME_SEED.mcap: the same messages, as those of ROS 2.
std::unique_ptr<DatasetWriter> mcap_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
