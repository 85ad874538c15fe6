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

/// A landmark that all particles know by its slot.
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

/// A landmark of one particle's map and its nearest neighbours of that colour in the others' maps.
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

std::vector<LandmarkEstimate> mixed_landmarks(const std::vector<Particle>& particles,
                                              const std::vector<double>& weights, std::size_t heaviest,
                                              const FrameReader& reader, double within_m) {
  const Particle& reported = particles[heaviest];
  std::vector<LandmarkEstimate> landmarks;
  for (std::size_t slot = 0; slot < reported.known.size(); ++slot) {
    const LandmarkBelief mixed = mixed_landmark(particles, weights, slot);
    const RangeBearing& first = reader.first_sighting(slot);
    landmarks.push_back({first.landmark_id, first.colour_class, mixed.mean, mixed.covariance,
                         reported.known[slot].status.origin});
  }
  for (std::size_t i = 0; i < reported.classed.size(); ++i) {
    const Landmark& own = reported.classed[i];
    if (!Existence::is_believed(own.status.log_odds)) continue;
    const LandmarkBelief mixed = mixed_landmark_near(particles, weights, own, within_m);
    landmarks.push_back({kUnknown, own.status.colour_class, mixed.mean, mixed.covariance, own.status.origin});
  }
  return landmarks;
}

std::vector<int> origins_of(const Particle& particle) {
  std::vector<int> origins;
  for (std::size_t slot = 0; slot < particle.known.size(); ++slot)
    origins.push_back(particle.known[slot].status.origin);
  for (std::size_t i = 0; i < particle.classed.size(); ++i) {
    const LandmarkStatus& status = particle.classed[i].status;
    if (!Existence::is_dead(status.log_odds)) origins.push_back(status.origin);
  }
  return origins;
}

}  // namespace stereobench::slam
