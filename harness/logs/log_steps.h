/// Streams of readings and sightings cut into the steps that filters are driven over.
#pragma once

#include "harness/logs/recorded_streams.h"
#include "harness/types.h"

namespace stereobench::harness {

/// Cuts streams into steps.
///
/// - **Instants** are the stated ones. Where none are stated, there is one at the first sighting of each
///   group (those within 1 ms of it belong to it), one at each end of the odometry, and as many between as
///   are needed for steps of at most 1 s, so that errors in long gaps without a landmark are scored too.
/// - **Odometry** is held: a reading's velocities hold until the next reading, the last until the end,
///   and before the first the robot stands. Held stretches are split exactly where a step ends.
/// - **Truth** at an instant lies on the line between its neighbours, the heading on the shorter arc; there
///   is none outside its span, nor within a gap of more than 1 s.
/// - The filters **start** at the first step's truth. Where it has none they start at the origin of a frame
///   of their own (MeasurementLog::start_is_true is false).
/// @param streams each in order of time, with at least one odometry reading
/// @throws std::runtime_error for a log of more than a million seconds whose steps are not stated: a clock
/// that jumps
MeasurementLog steps_from_streams(const RecordedStreams& streams);

}  // namespace stereobench::harness
