/// From what a detector found to what filters are given.
#pragma once

#include <span>
#include <vector>

#include "slam/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What a robot senses at a step of its path, and whose each measurement is.
struct Sightings {
  std::vector<slam::RangeBearing> measurements;
  std::vector<int> balls;  ///< index of the ball, which no filter is told, or kUnknown
};

/// The measurements a filter is given: trusted ones only, and where colours are unique the ball's identity,
/// which the robot knows by its colour.
/// @param balls_observed whose each observation is
Sightings sightings_of(std::span<const vision::BallObservation> observations,
                       std::span<const int> balls_observed, std::span<const worlds::Ball> balls,
                       worlds::Identity identity);

}  // namespace stereobench::harness
