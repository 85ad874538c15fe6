#include "slam/fastslam/mixture.h"

#include <algorithm>
#include <cmath>

#include "slam/association/existence.h"
#include "slam/math/moments.h"

namespace stereobench::slam {
namespace {

const Landmark* nearest(const LandmarkMap& map, const Landmark& own, double within_m) {
  const Eigen::Vector2d& place = own.belief.mean;
  const Landmark* best = nullptr;
  map.visit([&](const LandmarkBounds& bounds) { return bounds.places_m.exteriorDistance(place) <= within_m; },
            [&](std::size_t, const Landmark& landmark) {
              const double distance = (landmark.belief.mean - place).norm();
              if (landmark.status.colour_class != own.status.colour_class || distance > within_m) return;
              if (Existence::is_dead(landmark.status.log_odds)) return;
              best = &landmark;
              within_m = distance;
            });
  return best;
}

}  // namespace

PoseBelief mixed_pose(const std::vector<Posterior>& posteriors, const std::vector<double>& weights) {
  const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  const Pose reference = posteriors[static_cast<std::size_t>(heaviest)].pose.mean;
  Moments<3> moments;
  for (std::size_t i = 0; i < posteriors.size(); ++i) {
    const PoseBelief& belief = posteriors[i].pose;
    moments.add(weights[i], boxminus(belief.mean, reference), belief.covariance);
  }
  return {boxplus(reference, moments.mean()), moments.covariance()};
}

LandmarkBelief mixed_landmark(const std::vector<Particle>& particles, const std::vector<double>& weights,
                              std::size_t slot) {
  const Eigen::Vector2d reference = particles.front().known[slot].belief.mean;
  Moments<2> moments;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const LandmarkBelief& belief = particles[i].known[slot].belief;
    moments.add(weights[i], belief.mean - reference, belief.covariance);
  }
  return {reference + moments.mean(), moments.covariance()};
}

LandmarkBelief mixed_landmark_near(const std::vector<Particle>& particles, const std::vector<double>& weights,
                                   const Landmark& own, double within_m) {
  Moments<2> moments;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Landmark* same = nearest(particles[i].classed, own, within_m);
    if (same == nullptr) continue;
    moments.add(weights[i], same->belief.mean - own.belief.mean, same->belief.covariance);
  }
  return {own.belief.mean + moments.mean(), moments.covariance()};
}

}  // namespace stereobench::slam
