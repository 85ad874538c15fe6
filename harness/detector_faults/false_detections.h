/// Detections of nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/detector/ball_geometry.h"
#include "harness/detector_faults/detection.h"
#include "harness/experiment/detector_faults.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// How many detections of nothing a frame has: Poisson. @param mean more of it never gives fewer
int false_count(double mean, std::uint64_t seed, std::size_t frame);

/// A ball that is not there, on the ground that both cameras see up to false_within_m, uniform over its area,
/// at the height of the cameras. It has the colour of some ball of the world and the covariance of a
/// detection that states none (kUnstatedSd_px).
/// @param colours of the world's balls
/// @param number of those in the frame, from 0
/// @return empty where the cameras see no such ground
std::optional<TracedDetection> false_in_pictures(double within_m, const BallGeometry& geometry,
                                                 const std::vector<int>& colours, std::uint64_t seed,
                                                 std::size_t frame, int number);

/// The same of the oracle, uniform over its sector. Where sightings carry numbers it has none.
TracedDetection false_in_sector(const worlds::OracleSensor& sensor, worlds::Identity identity,
                                const std::vector<int>& colours, std::uint64_t seed, std::size_t frame,
                                int number);

}  // namespace stereobench::harness
