/// What a recording says of a robot's motion and of what it saw.
#pragma once

#include "harness/logs/recorded_streams.h"
#include "harness/verify/readers/recording/recorded_topics.h"

namespace stereobench::harness {

/// The odometry of a recording: a message tells the speeds since the one before. /sightings, and the true
/// path and landmarks of /ground_truth/pose_2d and /ground_truth/landmarks, where it has them.
/// What cannot be read, or has times that do not rise, is a fault.
/// @return without instants
RecordedStreams recorded_streams(OpenRecording& from);

}  // namespace stereobench::harness
