/// A drive as messages of the Robot Operating System, in order of time: what recordings of it hold.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "harness/dataset/dataset_drive.h"
#include "harness/dataset/formats/container/ros_schema.h"
#include "harness/types.h"

namespace stereobench::harness {

struct RosTopic {
  std::string_view name;
  RosType type;
  bool is_latched = false;  ///< who subscribes later is given the last message, too
};

/// All topics of a drive.
inline constexpr auto kRosTopics = std::to_array<RosTopic>({
    {"/tf_static", RosType::kTransforms, true},
    {"/tf", RosType::kTransforms},
    {"/odom", RosType::kOdometry},
    {"/ground_truth/pose", RosType::kPose},
    {"/ground_truth/pose_2d", RosType::kPlanarPose},
    {"/ground_truth/landmarks", RosType::kTable, true},
    {"/stereo/left/image_raw", RosType::kImage},
    {"/stereo/right/image_raw", RosType::kImage},
    {"/stereo/left/camera_info", RosType::kCameraInfo},
    {"/stereo/right/camera_info", RosType::kCameraInfo},
    {"/detections", RosType::kSpheres},
    {"/sightings", RosType::kTable},
    {"/ground_truth/balls", RosType::kSpheres},
});

/// The numbers of /sightings and of /ground_truth/landmarks: columns of observations.csv, without their time,
/// and of landmarks.csv.
inline constexpr auto kSightingColumns =
    std::to_array<std::string_view>({"landmark_id", "range_m", "bearing_rad", "colour_class", "range_var_m2",
                                     "cov_m_rad", "bearing_var_rad2"});
inline constexpr auto kLandmarkColumns =
    std::to_array<std::string_view>({"landmark_id", "x_m", "y_m", "colour_class"});

struct RosEvent {
  std::size_t topic = 0;  ///< index into kRosTopics
  std::uint32_t sequence = 0;
  std::int64_t stamp_ns = 0;  ///< from kEpoch_ns on
  std::string message;
};

/// Refuses what the messages have no place for: a right camera that is turned or late, a rig that vision is
/// told wrong, late frames, rolling shutters.
/// @throws std::runtime_error, one line that names the scenario's key
void check_ros_drive(const DatasetDrive& drive, std::string_view format);

/// Gives out all messages of a drive.
///
/// Frames: map (the world), base_link (the robot, z = 0), left_camera_optical, right_camera_optical, and
/// odom, which is the map as the measured odometry has it: both begin at the true start.
/// @param folder of the data set, which has the parts of each pair (pair_parts.h)
/// @param on_message called in order of time, which does not run backwards
void play_ros_drive(const DatasetDrive& drive, const MeasurementLog& log, RosVersion version,
                    const std::filesystem::path& folder,
                    const std::function<void(const RosEvent&)>& on_message);

}  // namespace stereobench::harness
