/// How far a log's odometry runs ahead of its sightings, told from the log alone.
#pragma once

#include <vector>

#include "harness/logs/recorded_streams.h"

namespace stereobench::harness {

/// A delay, and how it was come by.
struct OdometryDelay {
  double delay_s = 0.0;
  DelaySource source = DelaySource::kFound;
};

/// Estimates by how much the robot's motion follows what its odometry says.
///
/// Odometry that reports commands, or stamps that were taken before a queue, is early: a robot that turns by
/// 0.4 rad/s and follows 0.25 s later is 0.1 rad from where its odometry points, and no filter is told.
/// Between two sightings of one landmark, less than a second apart, its bearing changes by the robot's own
/// turn; the delay is the one at which the odometry predicts these changes best, by the sum of absolute
/// errors (outliers do not count for more). Neither the truth nor a map is looked at.
///
/// @param streams in order of time; sightings without an identity are left out
/// @return the delay between -0.5 and 1 s, on a grid of 10 ms: positive when the motion follows later; 0 when
///   no delay explains the sightings better than none by four standard errors, as in a log whose steps are
///   long or in which the robot never turns
OdometryDelay estimate_odometry_delay(const RecordedStreams& streams);

/// Moves every odometry reading by a delay, so that it lies beside the motion it speaks of.
void delay_odometry(std::vector<OdometryReading>& odometry, double delay_s);

}  // namespace stereobench::harness
