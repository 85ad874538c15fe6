/// The landmarks of a map that a sighting may be of, found without looking at all of them.
#pragma once

#include "slam/association/existence.h"
#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// How far around a sighting's place landmarks are looked for.
struct SearchReach {
  double gate = 0.0;    ///< squared Mahalanobis distance; none within it is missed
  double near_m = 0.0;  ///< nor any nearer than this
};

/// Where a sighting points at, and which parts of a map may hold its landmark: a generous first-order bound.
class SightingPlace {
 public:
  SightingPlace(const PoseBelief& from, const Observation& observation, const SearchReach& reach);

  const Eigen::Vector2d& mean_m() const { return mean_m_; }

  /// @return whether any landmark within such bounds may be the sighting's
  bool may_hold(const LandmarkBounds& bounds) const;

 private:
  Pose from_;
  Observation observation_;
  SearchReach reach_;
  Eigen::Vector2d mean_m_;
  double variance_m2_;
};

/// Visits the landmarks without an identity that a sighting may be of: of its colour, and not dead.
/// @param place of the sighting
/// @param visit (std::size_t index, const Landmark&)
template <class Visit>
void visit_alike(const LandmarkMap& map, const Sighting& sighting, const SightingPlace& place,
                 const Visit& visit) {
  map.visit([&](const LandmarkBounds& bounds) { return place.may_hold(bounds); },
            [&](std::size_t j, const Landmark& landmark) {
              if (landmark.colour_class != sighting.colour_class || Existence::is_dead(landmark.log_odds))
                return;
              visit(j, landmark);
            });
}

}  // namespace stereobench::slam
