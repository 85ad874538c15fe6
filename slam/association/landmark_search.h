/// The landmarks of a map that a sighting may be of, found without looking at all of them.
#pragma once

#include "slam/association/existence.h"
#include "slam/association/landmark.h"
#include "slam/association/sighting.h"

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
/// @param map has visit(may_matter, visit), as LandmarkMap
/// @param place of the sighting
/// @param visit (std::size_t index, const Landmark&)
template <class Map, class Visit>
void visit_alike(const Map& map, const Sighting& sighting, const SightingPlace& place, const Visit& visit) {
  map.visit([&](const LandmarkBounds& bounds) { return place.may_hold(bounds); },
            [&](std::size_t j, const Landmark& landmark) {
              const LandmarkStatus& status = landmark.status;
              if (status.colour_class == sighting.colour_class && !Existence::is_dead(status.log_odds))
                visit(j, landmark);
            });
}

}  // namespace stereobench::slam
