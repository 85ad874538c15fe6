/// Recordings of ROS 2, `mcap`.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what check_ros_drive (ros_drive.h) refuses.
void check_mcap_format(const DatasetDrive& drive);

/// Writes NAME_SEED.mcap: the messages of `rosbag` (rosbag_format.h), as those of ROS 2.
std::unique_ptr<DatasetWriter> mcap_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
