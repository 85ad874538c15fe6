#include "harness/scoring/coverage.h"

#include <algorithm>
#include <limits>

#include "harness/scoring/consistency.h"
#include "harness/scoring/landmark_map.h"

namespace stereobench::harness {
namespace {

/// Counts what lies within the ellipses.
struct Counts {
  std::array<long, kEllipses.size()> within = {};
  long positions = 0;

  void add(const Eigen::Vector2d& error_m, const Eigen::Matrix2d& covariance) {
    const auto squared = normalised_error(error_m, covariance);
    if (!squared) return;
    ++positions;
    const double smallest = chi_square_below(*squared);  // ellipse that holds it
    for (std::size_t i = 0; i < kEllipses.size(); ++i) within[i] += smallest <= kEllipses[i] ? 1 : 0;
  }
  EllipseCoverage fractions() const {
    EllipseCoverage coverage{.positions = positions};
    for (std::size_t i = 0; i < kEllipses.size(); ++i)
      coverage.within[i] = static_cast<double>(within[i]) / static_cast<double>(positions);  // 0 / 0
    return coverage;
  }
};

}  // namespace

EllipseCoverage cover_path(const FilterRun& run, const MeasurementLog& log) {
  Counts counts;
  const std::size_t steps = std::min({run.poses.size(), run.covariances.size(), log.steps.size()});
  for (std::size_t k = kFirstScoredStep; k < steps; ++k) {
    const auto& truth = log.steps[k].truth;
    if (!truth) continue;
    counts.add({run.poses[k].x_m - truth->x_m, run.poses[k].y_m - truth->y_m},
               run.covariances[k].topLeftCorner<2, 2>());
  }
  return counts.fractions();
}

EllipseCoverage cover_map(std::span<const slam::LandmarkEstimate> estimates,
                          std::span<const LandmarkTruth> truth) {
  Counts counts;
  for (const slam::LandmarkEstimate& estimate : estimates)
    if (const auto index = owner(estimate, estimate.position_m, truth))
      counts.add(estimate.position_m - truth[*index].position_m, estimate.covariance);
  return counts.fractions();
}

}  // namespace stereobench::harness
