/// A particle, what it sees, and what becomes of it: the values that one update passes along.
#pragma once

#include "slam/belief.h"
#include "slam/landmark_map.h"

namespace stereobench::slam {

/// A path's end and the map that belongs to the path. Copies share nothing.
struct Particle {
  Pose pose;            ///< as drawn at the last update
  LandmarkMap known;    ///< landmarks with an identity, by slot: the same slots in all particles
  LandmarkMap classed;  ///< landmarks with no more than a colour, in order of discovery

  /// @return this particle once more, for a life of its own: its map is shared until one of them changes it
  Particle descendant() const { return {pose, known.share(), classed.share()}; }
};

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
enum class Fate {
  kAdd,      ///< something that is not in the map yet
  kUse,      ///< corrects the pose, then the landmark
  kConfirm,  ///< speaks for a landmark that may be clutter, which is not trusted to correct the pose
  kMove,     ///< the landmark turned out to be wrong and is found anew
  kRefuse,   ///< contradicts its landmark and is not believed
  kIgnore,   ///< a double of another sighting, or too near a landmark to be new and too far to be it
};

/// A sighting's fate, and the index of its landmark in the particle's map; -1 where it has none.
struct Target {
  Fate fate = Fate::kAdd;
  int landmark = -1;
};

/// A particle's pose after what it saw, before it is drawn.
struct Posterior {
  PoseBelief pose;
  double log_likelihood = 0.0;  ///< of the whole frame, given the particle's path and map
  bool vouched = false;         ///< some landmark has corrected it in this frame
  bool pulled = false;          ///< a contradiction was settled against the odometry
};

/// The map that a sighting's landmark is in: by identity, or by colour alone.
inline const LandmarkMap& map_of(const Particle& particle, const Sighting& sighting) {
  return sighting.slot == kUnknown ? particle.classed : particle.known;
}
inline LandmarkMap& map_of(Particle& particle, const Sighting& sighting) {
  return sighting.slot == kUnknown ? particle.classed : particle.known;
}

/// The landmark in a particle's map that a target points at.
inline const Landmark& landmark_of(const Particle& particle, const Sighting& sighting, const Target& target) {
  return map_of(particle, sighting)[static_cast<std::size_t>(target.landmark)];
}

}  // namespace stereobench::slam
