/// Odometry that came with the pictures, as a measurement log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "harness/dataset_import/imported_frames.h"
#include "harness/logs/recorded_streams.h"
#include "harness/types.h"

namespace stereobench::harness {

/// Why a log has no place for odometry: it slides sideways, or it is that of another point than the robot of
/// the cameras, which is between them.
/// @param body_from_robot where the robot is on the body that the odometry is of
/// @return empty where it has
std::string why_without(const RecordedStreams& streams, const Eigen::Isometry3d& body_from_robot);

/// Adds the instants: those of pictures, of sightings and of the true path, and the true path where the
/// recording has it in space alone.
/// @param frames with times
/// @param log of the frames
void complete_streams(const std::vector<ViewFrame>& frames, const MeasurementLog& log,
                      RecordedStreams& streams);

/// The same with times that count from an epoch.
RecordedStreams since(std::int64_t epoch_ns, RecordedStreams streams);
MeasurementLog since(std::int64_t epoch_ns, MeasurementLog log);

}  // namespace stereobench::harness
