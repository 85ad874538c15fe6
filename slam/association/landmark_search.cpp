#include "slam/association/landmark_search.h"

#include <algorithm>

#include "slam/math/elementary.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr double kMargin = 4.0;  ///< by how much a squared distance may exceed its first order

/// How uncertain the place is that a sighting points at: the trace of its covariance, to first order.
double place_variance(const PoseBelief& belief, const Observation& observation) {
  const double range_m = observation.range_bearing.x();
  const double direction_rad = belief.mean.heading_rad + observation.range_bearing.y();
  const Eigen::Matrix3d& p = belief.covariance;
  const auto [s, c] = sine_cosine(direction_rad);
  const double turn_and_shift = p(1, 2) * c - p(0, 2) * s;
  return p(0, 0) + p(1, 1) + 2.0 * range_m * turn_and_shift + observation.noise(0, 0) +
         range_m * range_m * (p(2, 2) + observation.noise(1, 1));
}

/// How far from a pose anything within bounds can be.
double farthest_m(const Eigen::AlignedBox2d& places_m, const Pose& pose) {
  const Eigen::Array2d here(pose.x_m, pose.y_m);
  return (places_m.max().array() - here).max(here - places_m.min().array()).matrix().norm();
}

}  // namespace

SightingPlace::SightingPlace(const PoseBelief& from, const Observation& observation, const SearchReach& reach)
    : from_(from.mean),
      observation_(observation),
      reach_(reach),
      mean_m_(locate(from.mean, observation.range_bearing)),
      variance_m2_(place_variance(from, observation)) {}

bool SightingPlace::may_hold(const LandmarkBounds& bounds) const {
  const double growth_m2 = range_variance_growth(observation_, farthest_m(bounds.places_m, from_));
  const double gated_m2 = kMargin * reach_.gate * (variance_m2_ + growth_m2 + bounds.largest_variance_m2);
  return bounds.places_m.squaredExteriorDistance(mean_m_) <=
         std::max(gated_m2, reach_.near_m * reach_.near_m);
}

}  // namespace stereobench::slam
