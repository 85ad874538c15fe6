#include "vision/outline/edge_profile.h"

#include <algorithm>
#include <cmath>

#include "vision/outline/edge.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::vision {

void EdgeProfile::add(double distance_px, double shown, double whole, double weight) {
  const auto bin = static_cast<std::size_t>(std::abs(distance_px) / kBin_px);
  if (bin >= kBins) return;
  shown_[bin] += weight * whole * (distance_px < 0.0 ? whole - shown : shown);
  whole_[bin] += weight * whole * whole;
}

void EdgeProfile::add(const EdgeProfile& other) {
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    shown_[bin] += other.shown_[bin];
    whole_[bin] += other.whole_[bin];
  }
}

double EdgeProfile::blur_px() const {
  double blur2 = kEdgeProfile.first_px * kEdgeProfile.first_px;
  for (int step = 0; step < kEdgeProfile.steps; ++step) {
    const double blur = std::sqrt(blur2);
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const double distance = (static_cast<double>(bin) + 0.5) * kBin_px;
      const double slope = coverage_per_blur2(distance, blur);
      products += slope * (shown_[bin] - whole_[bin] * blurred_coverage(distance, blur).fraction);
      squares += slope * slope * whole_[bin];
    }
    if (!(squares > 0.0)) return 0.0;
    const double next =
        std::clamp(blur2 + products / squares, 0.0, kEdgeProfile.most_px * kEdgeProfile.most_px);
    const double change = std::abs(next - blur2);
    blur2 = next;
    if (change < kEdgeProfile.converged_px2) break;
  }
  return std::sqrt(blur2);
}

}  // namespace stereobench::vision
