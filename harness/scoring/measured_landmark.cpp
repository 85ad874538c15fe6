#include "harness/scoring/measured_landmark.h"

#include <algorithm>
#include <limits>

#include "slam/models/measurement.h"

namespace stereobench::harness {

std::optional<std::size_t> measured_landmark(const LogStep& step, std::size_t index,
                                             std::span<const LandmarkTruth> landmarks) {
  const slam::RangeBearing& sighting = step.measurements.at(index);
  std::optional<std::size_t> nearest;
  if (step.true_landmarks.size() == step.measurements.size()) {
    const int known = step.true_landmarks[index];
    if (known != slam::kUnknown) nearest = static_cast<std::size_t>(known);
    return nearest;
  }
  if (sighting.landmark_id != slam::kUnknown) {
    const auto named = std::ranges::find(landmarks, sighting.landmark_id, &LandmarkTruth::landmark_id);
    if (named != landmarks.end()) nearest = static_cast<std::size_t>(named - landmarks.begin());
    return nearest;
  }
  if (!step.truth) return nearest;
  const Eigen::Vector2d place_m = slam::locate(*step.truth, {sighting.range_m, sighting.bearing_rad});
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const double distance_m = (landmarks[i].position_m - place_m).norm();
    if (sighting.colour_class != landmarks[i].colour_class || distance_m >= nearest_m) continue;
    nearest = i;
    nearest_m = distance_m;
  }
  return nearest;
}

}  // namespace stereobench::harness
