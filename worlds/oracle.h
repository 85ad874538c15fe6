/// A sensor without pixels: the truth with Gaussian noise.
#pragma once

#include <vector>

#include "slam/random.h"
#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// Measures the range and bearing of every ball within the sensor's sector; walls hide nothing.
///
/// A ball is in view when its true horizontal range and bearing are within the sector; the noise is added
/// after that. A noisy range below zero is no sighting.
///
/// @param world its balls are the landmarks, their index is their identity
/// @param world_from_robot where the robot stands
/// @param sensor noise and sector
/// @param identity kKnown sets landmark_id, kColourClass sets colour_class; the other stays kUnknown
/// @param noise two normal draws are taken for each ball in view, in order of identity
/// @return sightings in order of identity, covariance diag(range_sd^2, bearing_sd^2); empty when none is in
/// view
std::vector<slam::RangeBearing> sense(const World& world, const slam::Pose& world_from_robot,
                                      const OracleSensor& sensor, Identity identity,
                                      slam::RandomStream& noise);

}  // namespace stereobench::worlds
