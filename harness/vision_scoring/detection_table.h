/// What happened to each ball and each detection, line by line: detections.csv.
#pragma once

#include <cstdint>
#include <string>

#include "harness/vision_scoring/frame_match.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// Its name beside a result, packed.
inline constexpr const char* kDetections = "detections.csv.gz";

/// A stereo pair of a run, and what it is taken of and with.
struct PairOfRun {
  std::uint64_t seed = 0;
  std::size_t frame = 0;  ///< the step of the path
  const worlds::World& world;
  const vision::StereoRig& rig;  ///< the true one
};

/// The first line of detections.csv.
std::string detections_csv_header();

/// The lines of one pair: one for each detection, in the detector's order, then one for each ball that had to
/// be found and was not. What does not exist is empty. Pixels are where a rig without distortion has them.
std::string detection_rows(const PairOfRun& pair, const FrameMatch& match);

}  // namespace stereobench::harness
