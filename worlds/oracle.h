/// A sensor without pixels: the truth with Gaussian noise, and what sensors miss and imagine.
#pragma once

#include <vector>

#include "slam/math/random.h"
#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// The measurements of one instant, and the true ball of each, which no filter is told.
struct Sightings {
  std::vector<slam::RangeBearing> measurements;
  std::vector<int> balls;  ///< index into World::balls, one for each sighting; kUnknown: of nothing
};

/// Measures the range and bearing of every ball within the sensor's sector; walls hide nothing.
///
/// A ball is in view when its true horizontal range and bearing are within the sector; the noise is added
/// after that. A noisy range below zero is no sighting.
///
/// @param world its balls are the landmarks, their index is their identity
/// @param world_from_robot where the robot stands
/// @param sensor noise and sector
/// @param identity kKnown sets landmark_id, kColourClass sets colour_class; what is not set stays kUnknown
/// @param noise two normal draws are taken for each ball in view, in order of identity
/// @return sightings in order of identity, covariance diag(range_sd^2, bearing_sd^2); empty when none is in
/// view
Sightings sense(const World& world, const slam::Pose& world_from_robot, const OracleSensor& sensor,
                Identity identity, slam::RandomStream& noise);

/// Takes away sightings that the sensor misses and adds behind them sightings of nothing, uniform over the
/// sector's area. One of those is like the others: it carries the colour of some ball where sightings carry
/// colours. Where they carry identities it has none, since nothing in the world bears one that would fit.
///
/// @param look all that is in view, from sense()
/// @param chance one draw is taken for each sighting, then three or four for each that is false; none where
/// nothing is missed and nothing imagined
Sightings with_faults(const Sightings& look, const World& world, const OracleSensor& sensor,
                      Identity identity, slam::RandomStream& chance);

}  // namespace stereobench::worlds
