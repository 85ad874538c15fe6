/// A particle: the end of a path, and the map that belongs to it.
#pragma once

#include <optional>

#include "slam/association/sighting.h"
#include "slam/fastslam/landmark_map.h"
#include "slam/models/belief.h"
#include "slam/models/chord.h"

namespace stereobench::slam {

/// A path's end and the map that belongs to the path. Copies share nothing.
struct Particle {
  Pose pose;            ///< as drawn at the last update
  LandmarkMap known;    ///< landmarks with an identity, by slot: the same slots in all particles
  LandmarkMap classed;  ///< landmarks with no more than a colour, in order of discovery

  /// @return this particle once more, for a life of its own: its map is shared until one of them changes it
  Particle descendant() const { return {pose, known.share(), classed.share()}; }
};

/// A particle's pose after what it saw, before it is drawn.
struct Posterior {
  PoseBelief pose;
  double log_likelihood = 0.0;             ///< of the whole frame, given the particle's path and map
  bool corroborated = false;               ///< some landmark has corrected it in this frame
  bool relocalised = false;                ///< a contradiction was settled against the odometry
  std::optional<ChordBelief> motion = {};  ///< to the pose, where it is the motion that is Gaussian
};

/// The map that a sighting's landmark is in: by identity, or by colour alone.
inline const LandmarkMap& map_of(const Particle& particle, const Sighting& sighting) {
  return sighting.slot == kUnknown ? particle.classed : particle.known;
}
inline LandmarkMap& map_of(Particle& particle, const Sighting& sighting) {
  return sighting.slot == kUnknown ? particle.classed : particle.known;
}

/// The landmark of an identity, or kUnknown when the particle has not met it.
inline int slot_in(const Particle& particle, int slot) {
  return static_cast<std::size_t>(slot) < particle.known.size() ? slot : kUnknown;
}

/// The landmark in a particle's map that a target points at.
inline const Landmark& landmark_of(const Particle& particle, const Sighting& sighting, const Target& target) {
  return map_of(particle, sighting)[static_cast<std::size_t>(target.landmark)];
}

}  // namespace stereobench::slam
