/// How often the truth lies where a filter says that it probably is.
#pragma once

#include <array>
#include <span>

#include "harness/types.h"

namespace stereobench::harness {

/// The probabilities of the ellipses that are looked into.
inline constexpr std::array<double, 3> kEllipses = {0.50, 0.95, 0.99};

/// One run's: of its positions, the fraction whose truth lies within each of the ellipses.
struct EllipseCoverage {
  std::array<double, kEllipses.size()> within = {};  ///< NaN when there is no position
  long positions = 0;                                ///< that have a truth and a covariance
};

/// Of the steps of a run, without its first two (see normalised_errors). Steps of one run depend on each
/// other: a fraction is one number a seed, and only seeds say how well it is known.
EllipseCoverage cover_path(const FilterRun& run, const MeasurementLog& log);

/// Of the landmarks in the end, in the world frame, those that belong to a true one.
EllipseCoverage cover_map(std::span<const slam::LandmarkEstimate> estimates,
                          std::span<const LandmarkTruth> truth);

}  // namespace stereobench::harness
