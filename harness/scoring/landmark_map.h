/// How far a map of landmarks is from the true one, and whether it holds each landmark once.
#pragma once

#include <optional>
#include <span>

#include "harness/types.h"

namespace stereobench::harness {

/// What a map is worth.
struct MapScore {
  double rms_m = 0.0;  ///< over all estimates that belong to a true landmark; NaN when none does
  double max_m = 0.0;
  long found_once = 0;  ///< true landmarks with one estimate
  long duplicated = 0;  ///< true landmarks with several
  long missed = 0;      ///< true landmarks with none
  long spurious = 0;    ///< estimates that belong to no true landmark
};

/// The true landmark that an estimate belongs to (see score_map), as an index.
/// @param position_m of the estimate, aligned
std::optional<std::size_t> owner(const slam::LandmarkEstimate& estimate, const Eigen::Vector2d& position_m,
                                 std::span<const LandmarkTruth> truth, double match_limit_m = 2.0);

/// The rotation and shift that bring a map's landmarks nearest to the true ones they belong to: what a map
/// that was made from an unknown start cannot be blamed for. (A path's own alignment is another one.)
/// @param truth_from_estimate from where estimates without an identity look for their landmark
/// @return identity when no estimate belongs to a true landmark
slam::Pose align_map(std::span<const slam::LandmarkEstimate> estimates, std::span<const LandmarkTruth> truth,
                     const slam::Pose& truth_from_estimate = {}, double match_limit_m = 2.0);

/// A landmark in another frame, with its covariance turned.
slam::LandmarkEstimate moved_landmark(const slam::Pose& target_from_source,
                                      const slam::LandmarkEstimate& landmark);

/// What a map is worth that nothing can be compared with: NaN for errors, and nothing counted.
MapScore unknown_map_score();

/// Scores a map. An estimate with an identity belongs to the landmark of that identity, however far it
/// is; one without belongs to the nearest landmark within the limit that its colour class, if it has one,
/// fits.
/// @param estimates the filter's map
/// @param truth the true landmarks; an empty list scores as all spurious
/// @param truth_from_estimate applied to the estimates first: identity, or align_map
/// @param match_limit_m the farthest that an estimate without an identity may be from its landmark
MapScore score_map(std::span<const slam::LandmarkEstimate> estimates, std::span<const LandmarkTruth> truth,
                   const slam::Pose& truth_from_estimate = {}, double match_limit_m = 2.0);

}  // namespace stereobench::harness
