#include "slam/fastslam/map_management.h"

#include <algorithm>

#include "slam/fastslam/landmark_search.h"
#include "slam/math/gaussian.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

bool contains(const std::vector<int>& indices, std::size_t index) {
  return std::ranges::find(indices, static_cast<int>(index)) != indices.end();
}

}  // namespace

MapManagement::MapManagement(const FilterConfig& config)
    : existence_(config.sector),
      gate_(chi_square_2_quantile(config.gate_probability)),
      near_m_(0.5 * config.colour_spacing_m) {}

void MapManagement::survey(const Particle& particle, std::span<const Sighting> frame,
                           std::span<const Target> targets) {
  claimed_.clear();
  unseen_.clear();
  vacant_.clear();
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (frame[k].slot == kUnknown && targets[k].landmark >= 0) claimed_.push_back(targets[k].landmark);
  }
  if (!existence_.is_tracked()) return;
  const Eigen::Vector2d robot(particle.pose.x_m, particle.pose.y_m);
  particle.classed.visit(
      [&](const LandmarkBounds& bounds) {
        return bounds.places_m.exteriorDistance(robot) <= existence_.range_m();
      },
      [&](std::size_t j, const Landmark& landmark) {
        if (Existence::is_dead(landmark.log_odds)) {
          vacant_.push_back(static_cast<int>(j));
        } else if (!contains(claimed_, j) && existence_.should_be_seen(particle.pose, landmark.belief)) {
          unseen_.push_back(static_cast<int>(j));
        }
      });
}

bool MapManagement::add(Particle& particle, const Sighting& sighting, const LandmarkBelief& found) {
  Landmark landmark{found, sighting.colour_class};
  landmark.origin = sighting.number;
  landmark.log_odds = existence_.founded();
  if (near_m_ > 0.0) {
    if (has_neighbour(particle.classed, landmark)) return false;
  } else if (const int other = lookalike(particle, sighting); other >= 0) {
    std::erase(unseen_, other);
    return false;
  }
  int place = static_cast<int>(particle.classed.size());
  if (vacant_.empty()) {
    particle.classed.push_back(landmark);
  } else {
    place = vacant_.back();
    vacant_.pop_back();
    particle.classed.replace(static_cast<std::size_t>(place), landmark);
  }
  claimed_.push_back(place);
  return true;
}

void MapManagement::weaken_unseen(Particle& particle) const {
  for (const int j : unseen_) {
    const auto index = static_cast<std::size_t>(j);
    Landmark landmark = particle.classed[index];
    landmark.log_odds = existence_.unseen(landmark.log_odds);
    particle.classed.replace(index, landmark);
  }
}

/// @return whether the map has a landmark of the same colour too near for another
bool MapManagement::has_neighbour(const LandmarkMap& map, const Landmark& landmark) const {
  const Eigen::Vector2d& place = landmark.belief.mean;
  bool found = false;
  map.visit(
      [&](const LandmarkBounds& bounds) {
        return !found && bounds.places_m.exteriorDistance(place) < near_m_;
      },
      [&](std::size_t, const Landmark& other) {
        const bool near = (other.belief.mean - place).norm() < near_m_ && !Existence::is_dead(other.log_odds);
        found = found || (near && other.colour_class == landmark.colour_class);
      });
  return found;
}

/// @return the landmark that a sighting from a known pose may be of, among those that are not claimed; -1 for
/// none
int MapManagement::lookalike(const Particle& particle, const Sighting& sighting) const {
  const Observation& observation = sighting.observation;
  const PoseBelief known{particle.pose, Eigen::Matrix3d::Zero()};
  const SightingPlace place(known, observation, {gate_, near_m_});
  double nearest = gate_;
  int like = -1;
  visit_alike(particle.classed, sighting, place, [&](std::size_t j, const Landmark& landmark) {
    if (contains(claimed_, j)) return;
    long repaired = 0;  // for a comparison only
    const PredictedMeasurement seen =
        Linearised().expect(particle.pose, landmark.belief, observation, repaired);
    const double squared_length =
        Factor2(seen.covariance, repaired)
            .squared_length(sighting_residual(observation.range_bearing, seen.expected));
    if (!(squared_length <= nearest)) return;
    nearest = squared_length;
    like = static_cast<int>(j);
  });
  return like;
}

}  // namespace stereobench::slam
