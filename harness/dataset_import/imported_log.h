/// The times and true poses of a data set as a measurement log.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "harness/dataset_import/imported_frames.h"
#include "harness/types.h"

namespace stereobench::harness {

/// A log, and what a plane has no place for.
struct ImportedLog {
  MeasurementLog log;            ///< a step a frame; without odometry and sightings
  bool world_is_kept = true;     ///< false: poses are relative to the first one
  double most_height_m = 0.0;    ///< by which a pose is above or below the first one
  double most_tilt_rad = 0.0;    ///< by which a pose's vertical axis leans
  double most_sideways_m = 0.0;  ///< that the robot moved between two frames, and wheels do not
};

/// Brings the poses of frames to the floor. Worlds whose z axis is up are kept. Others, as KITTI's, are those
/// of the robot's first pose.
/// @param frames with times
/// @param body_from_robot where the rig's robot is on the body that the poses are of
ImportedLog imported_log(const std::vector<ViewFrame>& frames, const Eigen::Isometry3d& body_from_robot);

/// Adds the odometry that leads from each true pose to the next: forward speed and turn rate, as wheels have
/// them.
/// @param imported all of whose steps have a true pose
/// @throws std::runtime_error, one line, where two steps have the same time
void add_odometry_from_truth(ImportedLog& imported);

}  // namespace stereobench::harness
