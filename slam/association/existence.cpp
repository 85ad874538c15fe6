#include "slam/association/existence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr double kLeastMissed = 0.1;  ///< no sensor, and no gate, lets less pass
constexpr double kLeastFalse = 1e-3;  ///< sightings of nothing a look
constexpr double kNewPerLook = 0.1;   ///< landmarks never seen before: a world is found once, clutter goes on
constexpr double kGateArea = 18.0;    ///< of the usual gate, in units of pi sd^2
constexpr float kLeastFounded = -4.0F;  ///< so that it can be seen a second time at all
constexpr double kWithin = 3.0;         ///< standard deviations between a landmark and the sector's border

}  // namespace

Existence::Existence(const SensorSector& sector) : sector_(sector) {
  if (!is_tracked()) return;
  const double false_per_look = std::max(sector.false_per_look, kLeastFalse);
  area_m2_ = sector.half_angle_rad * sector.range_m * sector.range_m;
  clutter_per_m2_ = false_per_look / area_m2_;
  founded_ = std::max(kLeastFounded, static_cast<float>(logarithm(kNewPerLook / false_per_look)));
  missed_ = static_cast<float>(logarithm(std::max(sector.miss_probability, kLeastMissed)));
}

float Existence::seen(float log_odds, const Observation& observation) const {
  if (!is_tracked()) return log_odds;
  const double spread_m2 =
      observation.range_bearing.x() *
      std::sqrt(std::max(0.0, noise_at(observation, observation.range_bearing).determinant()));
  const double by_clutter = clutter_per_m2_ * kPi * kGateArea * spread_m2;
  const double there = 1.0 - std::max(sector_.miss_probability, kLeastMissed);
  const double evidence = std::max(0.0, logarithm(there / by_clutter));
  return std::min(kSurest, log_odds + static_cast<float>(std::min<double>(evidence, kSurest)));
}

bool Existence::should_be_seen(const Pose& robot, const LandmarkBelief& landmark) const {
  const auto [expected, slope] = linearise_sighting(robot, landmark.mean);
  const Eigen::Vector2d sd =
      (slope * landmark.covariance * slope.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  return expected.x() + kWithin * sd.x() < sector_.range_m &&
         std::abs(expected.y()) + kWithin * sd.y() < sector_.half_angle_rad;
}

/// @param per_m2 density on the ground of what is seen
double Existence::cost_of(const Observation& observation, double per_m2) const {
  if (!is_tracked()) return std::numeric_limits<double>::infinity();
  constexpr double kNearest = 1e-3;  // of the sector's range
  const double range_m = std::max(observation.range_bearing.x(), kNearest * sector_.range_m);
  return -2.0 * logarithm(per_m2 * range_m);
}

double Existence::cost_of_new(const Observation& observation) const {
  return cost_of(observation, kNewPerLook / area_m2_ + clutter_per_m2_);
}

double Existence::cost_of_other(const Observation& observation, std::size_t shown) const {
  return cost_of(observation, static_cast<double>(shown) / area_m2_ + clutter_per_m2_);
}

double Existence::cost_of_place(std::size_t shown) const {
  return -2.0 * logarithm(static_cast<double>(shown) / area_m2_ + clutter_per_m2_);
}

}  // namespace stereobench::slam
