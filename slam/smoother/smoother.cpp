#include "slam/smoother/smoother.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "slam/association/landmark_search.h"
#include "slam/ekf/map_merging.h"
#include "slam/models/belief.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

/// By how much a pose may turn out to be elsewhere than predicted, in standard deviations.
constexpr double kFar = 4.0;

/// Room that a motion gets in all directions, as a standard deviation: a share of what the ranges of a frame
/// alone leave of a place, which is too little to be told (lab book, incremental smoothing).
constexpr double kShareOfFrame = 0.03;

/// Most of it, of the motion's own standard deviation: exact odometry stays exact.
constexpr double kShareOfMotion = 0.1;

/// Most landmarks that are looked at for doubles: what a covariance of all of them costs grows with its cube.
constexpr std::size_t kMostDoubles = 100;

/// A motion with room for a search. Where it is known not to leave a curve, steps along the curve are short.
///
/// @param frame at its end
PoseBelief with_slack(PoseBelief motion, std::span<const Sighting> frame) {
  double information_per_m2 = 0.0;
  for (const Sighting& sighting : frame) {
    const Observation& seen = sighting.observation;
    information_per_m2 += 1.0 / noise_at(seen, seen.range_bearing)(0, 0);
  }
  const double of_frame_m2 = kShareOfFrame * kShareOfFrame / information_per_m2;
  const double of_motion_m2 =
      kShareOfMotion * kShareOfMotion * motion.covariance.topLeftCorner<2, 2>().trace();
  motion.covariance.diagonal().head<2>().array() += std::min(of_frame_m2, of_motion_m2);
  return motion;
}

}  // namespace

Smoother::Smoother(const FilterConfig& config, const Pose& start)
    : policy_(config), graph_(start), reader_(config, start, Linearisation::kIterated) {}

void Smoother::update(std::span<const RangeBearing> sightings) {
  const std::vector<Sighting> frame = reader_.read(sightings);
  if (frame.empty()) return reader_.use(frame);
  const PoseBelief motion = reader_.motion();
  const std::vector<std::size_t> near = may_be_seen(frame);
  assume(near);
  reader_.use(frame);

  const PoseBelief drifted = after_drift(motion, graph_.pose(), reader_.drift());
  graph_.add_pose(with_slack(drifted, frame), reader_.belief().pose);
  // A landmark that is found anew has another variable from then on: what was used is held against the old
  // one.
  std::vector<int> seen(frame.size(), kUnknown);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Decision& decision = reader_.decided()[k];
    if (decision.outcome == Outcome::kUse) seen[k] = variable_of(decision.origin);
  }
  take_over_map(near);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Outcome outcome = reader_.decided()[k].outcome;
    if (outcome == Outcome::kAdd || outcome == Outcome::kMove) seen[k] = variable_found_by(frame[k]);
    if (seen[k] != kUnknown) graph_.add_sighting(seen[k], frame[k].observation);
  }
  for (const auto& [kept, dropped] : reader_.merged())
    graph_.add_same_place(variable_of(kept), variable_of(dropped));
  graph_.solve();
  if (!reader_.merged().empty()) merge_doubles(frame.size());
  assume({});
}

/// Makes one of landmarks anywhere that were found twice, once a loop is closed.
///
/// @param shown how many landmarks a look shows
void Smoother::merge_doubles(std::size_t shown) {
  const std::vector<std::size_t> near = may_be_doubles();
  const std::size_t before = reader_.merged().size();
  assume(near);
  if (!reader_.merge_doubles(shown)) return;
  take_over_map(near);
  for (const auto& [kept, dropped] : reader_.merged().subspan(before))
    graph_.add_same_place(variable_of(kept), variable_of(dropped));
  graph_.solve();
}

/// @return landmarks, as indices, that lie so near to another that they may be one: the nearest pairs
std::vector<std::size_t> Smoother::may_be_doubles() const {
  struct Pair {
    double squared_m2;
    std::size_t one, other;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < map_.size(); ++i) {
    if (!may_be_double(map_[i].kept.slot, map_[i].kept.status)) continue;
    const Eigen::Vector2d place = graph_.landmark(map_[i].variable);
    for (std::size_t j = 0; j < i; ++j) {
      if (!may_be_double(map_[j].kept.slot, map_[j].kept.status) ||
          map_[j].kept.status.colour_class != map_[i].kept.status.colour_class ||
          map_[j].kept.last_seen == map_[i].kept.last_seen)
        continue;
      const double squared_m2 = (graph_.landmark(map_[j].variable) - place).squaredNorm();
      if (squared_m2 <= policy_.gate * (map_[i].variance_m2 + map_[j].variance_m2))
        pairs.push_back({squared_m2, i, j});
    }
  }
  std::ranges::sort(pairs, [](const Pair& a, const Pair& b) {
    return std::tie(a.squared_m2, a.one, a.other) < std::tie(b.squared_m2, b.one, b.other);
  });
  std::set<std::size_t> near;
  for (const Pair& pair : pairs) {
    if (near.size() >= kMostDoubles) break;
    near.insert({pair.one, pair.other});
  }
  return {near.begin(), near.end()};
}

/// @return landmarks, as indices, that sightings may be of or that should be seen
std::vector<std::size_t> Smoother::may_be_seen(std::span<const Sighting> frame) const {
  const PoseBelief before{graph_.pose(), reader_.belief().covariance.pose()};
  const PoseBelief predicted = follow(before, policy_.search_motion(reader_.motion()));
  const double spread_m = std::sqrt(predicted.covariance.topLeftCorner<2, 2>().trace());
  const double looks_m = policy_.existence.range_m() + kFar * spread_m;
  std::vector<bool> taken(map_.size(), false);
  std::vector<SightingPlace> places;
  for (const Sighting& sighting : frame) {
    if (sighting.slot == kUnknown) {
      places.emplace_back(predicted, sighting.observation, SearchReach{policy_.gate, policy_.near_m});
    } else if (const auto slot = static_cast<std::size_t>(sighting.slot);
               slot < landmark_of_slot_.size() && landmark_of_slot_[slot] != kUnknown) {
      taken[static_cast<std::size_t>(landmark_of_slot_[slot])] = true;
    }
  }
  std::vector<std::size_t> near;
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].kept.slot == kUnknown && !places.empty()) {
      const Eigen::Vector2d place = graph_.landmark(map_[j].variable);
      const LandmarkBounds bounds{Eigen::AlignedBox2d(place), map_[j].variance_m2};
      taken[j] = (place - Eigen::Vector2d(predicted.mean.x_m, predicted.mean.y_m)).norm() < looks_m ||
                 std::ranges::any_of(places, [&](const SightingPlace& at) { return at.may_hold(bounds); });
    }
    if (taken[j]) near.push_back(j);
  }
  return near;
}

/// Hands the reader what the graph believes of the last pose and of some landmarks.
void Smoother::assume(std::span<const std::size_t> near) {
  std::vector<int> variables;
  std::vector<EkfSlam::Mapped> kept;
  for (const std::size_t j : near) {
    kept.push_back(map_[j].kept);
    variables.push_back(map_[j].variable);
  }
  graph_.catch_up(variables);
  JointBelief belief{.pose = graph_.pose()};
  for (const int variable : variables) belief.landmarks.push_back(graph_.landmark(variable));
  belief.covariance = JointCovariance(graph_.covariance(variables));
  reader_.assume(std::move(belief), std::move(kept));
}

/// Takes from the reader how landmarks have fared, and those that are new.
///
/// @param near the landmarks that it was told of
void Smoother::take_over_map(std::span<const std::size_t> near) {
  for (std::size_t i = 0; i < reader_.map().size(); ++i) {
    const EkfSlam::Mapped& read = reader_.map()[i];
    const std::size_t j = i < near.size() ? near[i] : map_.size();
    if (j == map_.size()) map_.emplace_back();
    if (const auto slot = static_cast<std::size_t>(read.slot); read.slot != kUnknown) {
      if (slot >= landmark_of_slot_.size()) landmark_of_slot_.resize(slot + 1, kUnknown);
      landmark_of_slot_[slot] = static_cast<int>(j);
    }
    Mapped& landmark = map_[j];
    if (landmark.kept.status.origin != read.status.origin)
      landmark.variable = graph_.add_landmark(reader_.belief().landmarks[i]);
    landmark.kept = read;
    landmark.variance_m2 = reader_.belief().covariance.landmark(static_cast<int>(i)).trace();
  }
}

/// @return in the graph, of the landmark that a sighting founded; kUnknown where there is none any more
int Smoother::variable_of(int origin) const {
  const auto found =
      std::ranges::find(map_, origin, [](const Mapped& mapped) { return mapped.kept.status.origin; });
  return found == map_.end() ? kUnknown : found->variable;
}

/// @return the same of what a sighting found, or of its identity
int Smoother::variable_found_by(const Sighting& sighting) const {
  if (sighting.slot == kUnknown) return variable_of(sighting.number);
  const int landmark = landmark_of_slot_[static_cast<std::size_t>(sighting.slot)];
  return map_[static_cast<std::size_t>(landmark)].variable;
}

Estimate Smoother::estimate_without_map() const {
  Estimate estimate = reader_.estimate_without_map();
  estimate.counters.covariance_repairs += graph_.repairs();
  return estimate;
}

Estimate Smoother::estimate() const {
  Estimate estimate = estimate_without_map();
  const std::vector<Eigen::Vector3d> places = graph_.settled();
  for (const Mapped& landmark : map_) {
    if (!EkfSlam::is_reported(landmark.kept)) continue;
    const std::vector<int> variables{landmark.variable};
    const Eigen::Matrix2d covariance = graph_.covariance(variables).bottomRightCorner<2, 2>();
    estimate.landmarks.push_back(reader_.reported(
        landmark.kept, {places[static_cast<std::size_t>(landmark.variable)].head<2>(), covariance}));
  }
  return estimate;
}

Decisions Smoother::last_decisions() const {
  Decisions decisions{after_merging(reader_.decided(), reader_.merged()), {}};
  for (const Mapped& landmark : map_) {
    if (!Existence::is_dead(landmark.kept.status.log_odds))
      decisions.mapped.push_back(landmark.kept.status.origin);
  }
  return decisions;
}

}  // namespace stereobench::slam
