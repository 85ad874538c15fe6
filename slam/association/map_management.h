/// What a frame tells a map besides where landmarks are: which are there, and what is new.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "slam/association/frame_association.h"
#include "slam/association/policy.h"

namespace stereobench::slam {

/// The status of a landmark that is new.
LandmarkStatus founded_by(const Sighting& sighting, const Existence& existence);

/// Writes down for a landmark what became of a sighting that was held against it.
void note_sighting(LandmarkStatus& status, const Sighting& sighting, Outcome outcome,
                   const Existence& existence);

/// Keeps account of the landmarks without an identity. Landmarks with one are there because somebody says so.
///
/// A landmark within the sensor's sector that nothing in the frame is held against loses odds. One that is
/// dead stays where it is in the map, unseen by all searches, until a new landmark takes its place: a map
/// does not grow with the clutter of one place. A frame that shows nothing at all is no evidence, as it is
/// none at all.
class MapManagement {
 public:
  explicit MapManagement(const FilterConfig& config) : policy_(config) {}

  const Existence& existence() const { return policy_.existence; }

  /// Puts what is new into a map, and takes odds from what should have been seen and was not.
  ///
  /// A sighting is not new when no landmark can be there, or when it may be of one that is in the map
  /// already: from the corrected pose it lies within the gate of one that no other sighting of the frame is
  /// held against. That one is then neither seen nor missed.
  ///
  /// @param map corrected by what the frame shows of it. It offers pose(), landmark_of(slot), visit() and
  /// misfit() as a belief does in associate(), and
  ///   - `LandmarkBelief found(const Observation&)`: a landmark seen for the first time
  ///   - `see_again(int landmark, const Sighting&)`: an identity, in the frame that found it
  ///   - `int add(const Sighting&, const Landmark&, std::vector<int>& vacant)`: returns where it was put, at
  ///     the end or in a vacant place, which is then taken from the list
  ///   - `set_log_odds(std::size_t j, float)`
  ///   - `kClaimsLookalikes`: whether a second such sighting of a frame, of the same landmark, is new
  ///   - `LandmarkBelief seen_from_robot(std::size_t j, const Landmark&)`: as if the pose were exact
  /// @param targets kAdd becomes kIgnore for what is no new landmark, kDouble becomes kAdd
  template <class Map>
  void update(Map& map, std::span<const Sighting> frame, std::span<Target> targets, long& gated);

 private:
  template <class Map>
  void survey(const Map& map, std::span<const Sighting> frame, std::span<const Target> targets);
  template <class Map>
  Outcome add(Map& map, const Sighting& sighting, bool may_be_double);
  template <class Map>
  bool may_be_mapped(const Map& map, const Sighting& sighting, const Eigen::Vector2d& place);
  template <class Map>
  bool has_neighbour(const Map& map, int colour_class, const Eigen::Vector2d& place) const;
  template <class Map>
  int lookalike(const Map& map, const Sighting& sighting) const;
  bool is_claimed(std::size_t j) const {
    return std::ranges::find(claimed_, static_cast<int>(j)) != claimed_.end();
  }

  AssociationPolicy policy_;
  std::vector<int> claimed_;  ///< landmarks that sightings of the frame are held against
  std::vector<std::pair<std::size_t, float>> unseen_;  ///< landmarks and the log odds that are left to them
  std::vector<int> vacant_;                            ///< dead landmarks nearby
};

template <class Map>
void MapManagement::update(Map& map, std::span<const Sighting> frame, std::span<Target> targets,
                           long& gated) {
  survey(map, frame, targets);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const bool may_be_double = targets[k].outcome == Outcome::kDouble;
    if (targets[k].outcome != Outcome::kAdd && !may_be_double) continue;
    targets[k].outcome = add(map, frame[k], may_be_double);
    if (targets[k].outcome == Outcome::kIgnore) ++gated;
  }
  for (const auto& [j, log_odds] : unseen_) map.set_log_odds(j, log_odds);
}

/// Looks over the landmarks that should have been seen, when those that were seen are up to date.
template <class Map>
void MapManagement::survey(const Map& map, std::span<const Sighting> frame, std::span<const Target> targets) {
  claimed_.clear();
  unseen_.clear();
  vacant_.clear();
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (frame[k].slot == kUnknown && targets[k].landmark >= 0) claimed_.push_back(targets[k].landmark);
  }
  const Existence& existence = policy_.existence;
  if (!existence.is_tracked()) return;
  const Pose robot = map.pose().mean;
  const Eigen::Vector2d place(robot.x_m, robot.y_m);
  map.visit(
      [&](const LandmarkBounds& bounds) {
        return bounds.places_m.exteriorDistance(place) <= existence.range_m();
      },
      [&](std::size_t j, const Landmark& landmark) {
        const float log_odds = landmark.status.log_odds;
        if (Existence::is_dead(log_odds)) {
          vacant_.push_back(static_cast<int>(j));
        } else if (!is_claimed(j) && existence.should_be_seen(robot, map.seen_from_robot(j, landmark))) {
          unseen_.emplace_back(j, existence.unseen(log_odds));
        }
      });
}

/// @param may_be_double whether it is added even so
/// @return kAdd, or kIgnore for what is no new landmark
template <class Map>
Outcome MapManagement::add(Map& map, const Sighting& sighting, bool may_be_double) {
  const bool has_identity = sighting.slot != kUnknown;
  if (const int landmark = has_identity ? map.landmark_of(sighting.slot) : kUnknown; landmark >= 0) {
    map.see_again(landmark, sighting);
    return Outcome::kAdd;
  }
  const Landmark landmark{map.found(sighting.observation), founded_by(sighting, policy_.existence)};
  if (!has_identity && !may_be_double && may_be_mapped(map, sighting, landmark.belief.mean))
    return Outcome::kIgnore;
  const int place = map.add(sighting, landmark, vacant_);
  if (!has_identity) claimed_.push_back(place);
  return Outcome::kAdd;
}

/// @param place where the sighting would found a landmark
template <class Map>
bool MapManagement::may_be_mapped(const Map& map, const Sighting& sighting, const Eigen::Vector2d& place) {
  if (policy_.near_excludes()) return has_neighbour(map, sighting.colour_class, place);
  const int other = lookalike(map, sighting);
  std::erase_if(unseen_, [&](const auto& unseen) { return static_cast<int>(unseen.first) == other; });
  if (other >= 0 && Map::kClaimsLookalikes) claimed_.push_back(other);
  return other >= 0;
}

/// @return whether the map has a landmark of the same colour too near for another
template <class Map>
bool MapManagement::has_neighbour(const Map& map, int colour_class, const Eigen::Vector2d& place) const {
  bool found = false;
  map.visit(
      [&](const LandmarkBounds& bounds) {
        return !found && bounds.places_m.exteriorDistance(place) < policy_.near_m;
      },
      [&](std::size_t, const Landmark& other) {
        const bool near = (other.belief.mean - place).norm() < policy_.near_m;
        found = found || (near && other.status.colour_class == colour_class &&
                          !Existence::is_dead(other.status.log_odds));
      });
  return found;
}

/// @return the landmark that a sighting may be of, among those that are not claimed; -1 for none
template <class Map>
int MapManagement::lookalike(const Map& map, const Sighting& sighting) const {
  const SightingPlace place(map.pose(), sighting.observation, {policy_.gate, policy_.near_m});
  double nearest = policy_.gate;
  int like = -1;
  visit_alike(map, sighting, place, [&](std::size_t j, const Landmark& landmark) {
    if (is_claimed(j)) return;
    const double squared_length = map.misfit(j, landmark, sighting.observation).squared_length;
    if (!(squared_length <= nearest)) return;
    nearest = squared_length;
    like = static_cast<int>(j);
  });
  return like;
}

}  // namespace stereobench::slam
