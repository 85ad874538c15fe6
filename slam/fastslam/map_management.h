/// What a frame tells a particle's map besides where landmarks are: which are there, and what is new.
#pragma once

#include <span>
#include <vector>

#include "slam/association/existence.h"
#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// Keeps account of the landmarks without an identity, for one particle after the other. Landmarks with one
/// are there because somebody says so.
///
/// A landmark within the sensor's sector that nothing in the frame is held against loses odds. One that is
/// dead stays where it is in the map, unseen by all searches, until a new landmark nearby takes its place: a
/// map does not grow with the clutter of one place. A frame that shows nothing at all is no evidence, as it
/// is none at all.
class MapManagement {
 public:
  explicit MapManagement(const FilterConfig& config);

  const Existence& existence() const { return existence_; }

  /// Looks over the landmarks that should have been seen, when those that were seen are up to date.
  /// @param particle its pose as drawn
  void survey(const Particle& particle, std::span<const Sighting> frame, std::span<const Target> targets);

  /// Puts a new landmark into the map, unless none can be there or it may be one that is in the map already:
  /// from the corrected pose it lies within the gate of one that no other sighting of the frame is held
  /// against. That one is then neither seen nor missed.
  /// @return whether it was new
  bool add(Particle& particle, const Sighting& sighting, const LandmarkBelief& found);

  /// Takes the odds from what should have been seen and was not.
  void weaken_unseen(Particle& particle) const;

 private:
  bool has_neighbour(const LandmarkMap& map, const Landmark& landmark) const;
  int lookalike(const Particle& particle, const Sighting& sighting) const;

  Existence existence_;
  double gate_;
  double near_m_;             ///< within this distance there is one landmark of a colour; 0 = not known
  std::vector<int> claimed_;  ///< landmarks that sightings of the frame are held against
  std::vector<int> unseen_;
  std::vector<int> vacant_;  ///< dead landmarks nearby
};

}  // namespace stereobench::slam
