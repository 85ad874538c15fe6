/// What became of each ball and each detection of one stereo pair, for people.
#pragma once

#include <string>

#include "harness/frame_replay/frame_replay.h"

namespace stereobench::harness {

/// A line for each detection, in the detector's order, then one for each ball that was not found: range and
/// bearing errors, errors of the centres in each camera, and the squared error in units of the covariance
/// that the detector states.
std::string frame_table(const ReplayedFrame& frame);

/// The lines that a table of detections has of a frame.
/// @param detections of detections.csv, with its header, plain or gzip
/// @throws std::runtime_error when it cannot be read
std::string rows_in_table(const std::filesystem::path& detections, const FrameName& frame);

}  // namespace stereobench::harness
