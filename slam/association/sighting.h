/// A measurement on its way through an update, and what becomes of it.
#pragma once

#include "slam/models/belief.h"

namespace stereobench::slam {

/// A sighting that passed the checks. Its slot is the identity's index, or kUnknown when only a colour was
/// seen.
struct Sighting {
  Observation observation;
  int slot = kUnknown;
  int colour_class = kUnknown;
  int number = kUnknown;  ///< counted over all sightings a filter was given
  int index = 0;          ///< among the sightings as they came in
};

/// What becomes of a sighting.
enum class Outcome {
  kAdd,      ///< something that is not in the map yet
  kUse,      ///< corrects the pose, then the landmark
  kConfirm,  ///< speaks for a landmark that may be clutter, which is not trusted to correct the pose
  kMove,     ///< the landmark turned out to be wrong and is found anew
  kRefuse,   ///< contradicts its landmark and is not believed
  kIgnore,   ///< a double of another sighting, or too near a landmark to be new and too far to be it
  kDouble,   ///< may be of several landmarks: a new one until the map tells which of them it is
};

/// A sighting's outcome, and the index of its landmark in the particle's map; -1 where it has none.
struct Target {
  Outcome outcome = Outcome::kAdd;
  int landmark = -1;
};

/// What was expected of a sighting, just before it was used.
struct ExpectedSighting {
  bool exists = false;  ///< there was a landmark for it
  Eigen::Vector2d range_bearing = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< S
  double log_likelihood = 0.0;  ///< of the sighting, or of the gate where it was refused
};

}  // namespace stereobench::slam
