#include "harness/detector_faults/misses.h"

#include <algorithm>

#include "harness/detector_faults/fault_draws.h"

namespace stereobench::harness {
namespace {

/// Linear between the points, constant beyond; 0 where there is none.
double interpolated(const std::vector<Eigen::Vector2d>& points, double x) {
  if (points.empty()) return 0.0;
  const auto above =
      std::ranges::find_if(points, [x](const Eigen::Vector2d& point) { return point.x() >= x; });
  if (above == points.begin()) return points.front().y();
  if (above == points.end()) return points.back().y();
  const Eigen::Vector2d low = *(above - 1), high = *above;
  return low.y() + (high.y() - low.y()) * (x - low.x()) / (high.x() - low.x());
}

}  // namespace

double loss_probability(const DetectorFaults& faults, double range_m,
                        std::optional<double> visible_fraction) {
  const double by_visible = visible_fraction ? interpolated(faults.miss_by_visible, *visible_fraction) : 0.0;
  const double by_range = interpolated(faults.miss_by_range, range_m);
  return 1.0 - (1.0 - faults.miss_probability) * (1.0 - by_visible) * (1.0 - by_range);
}

bool is_lost(const DetectorFaults& faults, std::uint64_t seed, std::size_t frame, std::uint64_t detection,
             double probability) {
  const auto length = static_cast<std::uint64_t>(faults.miss_burst_frames);
  std::uint64_t block = frame;
  if (length > 1) {
    const double clock = fault_draws(seed, FaultDraw::kBurst, 0, detection).uniform();
    block = (frame + static_cast<std::uint64_t>(clock * static_cast<double>(length))) / length;
  }
  return fault_draws(seed, FaultDraw::kMiss, block, detection).uniform() < probability;
}

}  // namespace stereobench::harness
