#include "slam/ekf/ekf_slam.h"

#include <algorithm>
#include <utility>

#include "slam/association/contradiction.h"
#include "slam/ekf/joint_moments.h"
#include "slam/ekf/map_merging.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

/// Over so many frames odometry keeps landmarks together that are laid over the map.
constexpr int kRecentFrames = 20;

}  // namespace

/// The belief and its landmarks, as the rules of association and of the map read and write them.
struct EkfSlam::View {
  static constexpr bool kClaimsLookalikes = true;
  static constexpr bool kTiesLandmarks = true;
  EkfSlam& filter;
  Eigen::Matrix3d room = Eigen::Matrix3d::Zero();  ///< of the pose, beside its covariance

  PoseBelief pose() const { return {filter.belief_.pose, filter.belief_.covariance.pose() + room}; }

  int landmark_of(int slot) const {
    const auto found = std::ranges::find(filter.map_, slot, &Mapped::slot);
    return found == filter.map_.end() ? kUnknown : static_cast<int>(found - filter.map_.begin());
  }

  /// All of them: there are few, and an innovation costs less than the search for those that matter.
  template <class MayMatter, class Visit>
  void visit(const MayMatter&, const Visit& visit) const {
    for (std::size_t j = 0; j < filter.map_.size(); ++j) {
      if (filter.map_[j].slot == kUnknown) visit(j, filter.landmark(j));
    }
  }

  JointInnovation innovation(std::size_t j, const Observation& observation) const {
    long& repairs = filter.counters_.covariance_repairs;
    const int landmark = static_cast<int>(j);
    JointInnovation seen = filter.policy_.merges
                               ? innovation_at_sighting(filter.belief_, landmark, observation, repairs)
                               : slam::innovation(filter.belief_, landmark, observation, repairs);
    if (room.isZero(0.0)) return seen;
    const auto by_pose = seen.slope.leftCols<3>();
    seen.covariance += by_pose * room * by_pose.transpose();
    seen.factor = Factor2(seen.covariance, repairs);
    return seen;
  }

  Misfit misfit(std::size_t j, const Landmark&, const Observation& observation) const {
    const JointInnovation seen = innovation(j, observation);
    return {seen.squared_length(), seen.squared_length() + seen.factor.log_det_2_pi()};
  }

  JointInnovations innovations(std::span<const Candidate> candidates, std::span<const Sighting> frame) const {
    std::vector<Pairing> pairings;
    std::vector<JointInnovation> all;
    for (const Candidate& pair : candidates) {
      all.push_back(innovation(static_cast<std::size_t>(pair.landmark),
                               frame[static_cast<std::size_t>(pair.sighting)].observation));
      pairings.push_back({all.back().residual, all.back().covariance});
    }
    const auto tie = [this, all, candidates](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
      const int one = candidates[a].landmark;
      const int other = candidates[b].landmark;
      Eigen::Matrix<double, 5, 5> shared = filter.belief_.covariance.between(one, other);
      shared.topLeftCorner<3, 3>() += room;
      return all[a].slope * shared * all[b].slope.transpose();
    };
    return {std::move(pairings), tie};
  }

  LandmarkBelief seen_from_robot(std::size_t j, const Landmark& landmark) const {
    const Eigen::Vector2d& place = landmark.belief.mean;
    Eigen::Matrix<double, 2, 5> apart = Eigen::Matrix<double, 2, 5>::Zero();
    apart.leftCols<2>() = -Eigen::Matrix2d::Identity();
    apart.col(2) = heading_lever(filter.belief_.pose, place) * -1.0;
    apart.rightCols<2>().setIdentity();
    const auto joint = filter.belief_.covariance.pose_and_landmark(static_cast<int>(j));
    return {place, apart * joint * apart.transpose()};
  }

  LandmarkBelief found(const Observation& observation) const {
    return filter.model_.found(filter.belief_.pose, observation, filter.counters_.covariance_repairs);
  }

  void see_again(int landmark, const Sighting& sighting) {
    ExpectedSighting expected;
    filter.learn({filter.correct_by(landmark, sighting, true, expected), landmark}, sighting);
  }

  /// The rows of a dead landmark are as good as new ones; landmarks with an identity stay in their order.
  int add(const Sighting& sighting, const Landmark& landmark, std::vector<int>& vacant) {
    int j = static_cast<int>(filter.map_.size());
    if (vacant.empty() || sighting.slot != kUnknown) {
      filter.map_.emplace_back();
    } else {
      j = vacant.front();
      vacant.erase(vacant.begin());
    }
    filter.map_[static_cast<std::size_t>(j)] = {sighting.slot, landmark.status, filter.frames_};
    filter.find_landmark(j, sighting.observation);
    return j;
  }

  void set_log_odds(std::size_t j, float log_odds) { filter.map_[j].status.log_odds = log_odds; }
};

EkfSlam::EkfSlam(const FilterConfig& config, const Pose& start, Linearisation linearisation)
    : config_(config),
      linearisation_(linearisation),
      policy_(config),
      management_(config),
      unscented_(config.unscented),
      reader_(config),
      belief_{.pose = start} {}

void EkfSlam::predict(const Control& control) {
  move(motion_, model_, control, config_.odometry_noise, counters_);
}

void EkfSlam::update(std::span<const RangeBearing> sightings) {
  use(read(sightings));
}

std::vector<Sighting> EkfSlam::read(std::span<const RangeBearing> sightings) {
  return reader_.read(sightings, counters_.rejected_inputs);
}

void EkfSlam::assume(JointBelief belief, std::vector<Mapped> map) {
  belief_ = std::move(belief);
  map_ = std::move(map);
}

void EkfSlam::start_anew(const Pose& pose) {
  belief_.pose = pose;
  belief_.landmarks.clear();
  belief_.covariance.clear();
  map_.clear();
}

void EkfSlam::take_up(int slot, const Landmark& landmark) {
  const auto j = static_cast<int>(map_.size());
  map_.push_back({slot, landmark.status});
  belief_.landmarks.push_back(landmark.belief.mean);
  belief_.covariance.place(j, Eigen::Matrix<double, 2, 3>::Zero(), landmark.belief.covariance,
                           counters_.covariance_repairs);
}

void EkfSlam::use(std::span<const Sighting> frame) {
  use(frame, frame.empty() ? PoseBelief{} : std::exchange(motion_, {}));
}

void EkfSlam::use(std::span<const Sighting> frame, const PoseBelief& motion) {
  report_ = {};
  decided_.clear();
  targets_.assign(frame.size(), {});
  expected_.assign(frame.size(), {});
  used_.clear();
  merged_.clear();
  drift_.setZero();
  if (frame.empty()) return;
  ++frames_;
  std::optional<JointBelief> before;
  if (linearisation_ != Linearisation::kOnce) before = belief_;
  const Eigen::Matrix3d moved = follow(belief_.pose, motion).covariance;
  follow(belief_, motion);
  Decided decided = decide(frame, (policy_.motion_scale - 1.0) * moved);
  if (before)
    correct_iterated(decided, *std::move(before), motion);
  else
    correct_one_by_one(decided);
  decided_ = decisions_of(frame, decided.targets, [&](const Sighting&, const Target& target) {
    return map_[static_cast<std::size_t>(target.landmark)].status.origin;
  });
  for (const std::size_t k : decided.order) learn(decided.targets[k], frame[k]);
  View view{*this};
  management_.update(view, frame, decided.targets, counters_.gated_measurements);
  for (std::size_t k = 0; k < frame.size(); ++k) decided_[k].outcome = decided.targets[k].outcome;
  for (const UsedSighting& used : used_) map_[static_cast<std::size_t>(used.landmark)].last_seen = frames_;
  // What was seen of late tells which places are one, and that tells it of all others.
  if (policy_.merges && merge_doubles(kRecentFrames, frame.size())) merge_doubles(frame.size());
}

/// @param room of the pose that landmarks without an identity are searched with, beside its covariance
EkfSlam::Decided EkfSlam::decide(std::span<const Sighting> frame, const Eigen::Matrix3d& room) {
  Decided decided{frame, targets_, {}};
  associate(policy_, View{*this, room}, frame, decided.targets, counters_.joint_searches_cut);
  order_by_age(decided.targets, decided.order);
  return decided;
}

void EkfSlam::correct_one_by_one(Decided& decided) {
  bool corroborated = false;
  for (const std::size_t k : decided.order) {
    Target& target = decided.targets[k];
    target.outcome = correct_by(target.landmark, decided.frame[k], corroborated, expected_[k]);
    corroborated |= target.outcome == Outcome::kUse;
  }
}

/// @param corroborated whether some landmark has corrected the pose in this frame
/// @param expected receives what was expected of the sighting
Outcome EkfSlam::correct_by(int landmark, const Sighting& sighting, bool corroborated,
                            ExpectedSighting& expected) {
  const Observation& observation = sighting.observation;
  long& repairs = counters_.covariance_repairs;
  const long before = repairs;
  JointInnovation seen = innovation(belief_, landmark, observation, repairs);
  if (config_.report_updates) report_.innovations.push_back({sighting.index, seen.squared_length()});
  if (!(seen.squared_length() <= policy_.gate)) {
    ++counters_.gated_measurements;
    const auto j = static_cast<std::size_t>(landmark);
    const Outcome outcome =
        judge_contradiction(map_[j].status.record, policy_.is_certain(sighting), corroborated);
    if (outcome != Outcome::kUse) {
      if (config_.report_updates) report_.innovations.back().refused = true;
      expected = expectation(seen, observation, policy_.gate);
      return outcome;
    }
    const Eigen::Matrix3d drift = drift_covariance(belief_.pose, belief_.landmarks[j], observation);
    belief_.covariance.move_pose(Eigen::Vector2d::Zero(), drift);
    drift_ += drift;
    seen = innovation(belief_, landmark, observation, repairs);
  }
  expected = correct_and_note(landmark, seen, observation, repairs == before);
  return Outcome::kUse;
}

/// @param teaches false where all is certain: then nothing is learnt, and the sighting weighs nothing
/// @return what was expected of it
ExpectedSighting EkfSlam::correct_and_note(int landmark, const JointInnovation& seen,
                                           const Observation& observation, bool teaches) {
  ExpectedSighting expected = expectation(seen, observation, seen.squared_length());
  if (!teaches) expected.log_likelihood = 0.0;
  if (teaches) correct(belief_, landmark, seen, counters_.covariance_repairs);
  used_.push_back({landmark, observation});
  return expected;
}

/// Takes a landmark, of the map or one more, for what is seen now.
void EkfSlam::find_landmark(int landmark, const Observation& observation) {
  std::erase_if(used_, [&](const UsedSighting& one) { return one.landmark == landmark; });
  used_.push_back({landmark, observation});
  long& repairs = counters_.covariance_repairs;
  if (linearisation_ == Linearisation::kSigmaPoints)
    find(unscented_, belief_, landmark, observation, repairs);
  else
    find(model_, belief_, landmark, observation, repairs);
}

void EkfSlam::learn(const Target& target, const Sighting& sighting) {
  if (target.outcome == Outcome::kMove) find_landmark(target.landmark, sighting.observation);
  note_sighting(map_[static_cast<std::size_t>(target.landmark)].status, sighting, target.outcome,
                policy_.existence);
}

/// Makes one of landmarks that were seen of late and older ones, where the map tells which is which.
///
/// @param recent frames
/// @return whether there were any
bool EkfSlam::merge_doubles(int recent, std::size_t shown) {
  std::vector<LandmarkSeen> seen;
  for (const auto& [slot, status, first_seen, last_seen] : map_)
    seen.push_back({slot, status, frames_ - first_seen, frames_ - last_seen});
  const std::size_t before = merged_.size();
  for (const auto& [kept, dropped] :
       find_doubles(policy_, belief_, seen, recent, shown, counters_.joint_searches_cut)) {
    Mapped& old = map_[static_cast<std::size_t>(kept)];
    Mapped& late = map_[static_cast<std::size_t>(dropped)];
    // One of them was itself another's double.
    if (Existence::is_dead(old.status.log_odds) || Existence::is_dead(late.status.log_odds)) continue;
    merge(belief_, dropped, kept, counters_.covariance_repairs);
    merged_.push_back({old.status.origin, late.status.origin});
    old.last_seen = late.last_seen;
    late.status.log_odds = Existence::dead();
  }
  return merged_.size() > before;
}

Landmark EkfSlam::landmark(std::size_t j) const {
  return {{belief_.landmarks[j], belief_.covariance.landmark(static_cast<int>(j))}, map_[j].status};
}

Estimate EkfSlam::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (is_reported(map_[j])) estimate.landmarks.push_back(reported(map_[j], landmark(j).belief));
  }
  return estimate;
}

bool EkfSlam::is_reported(const Mapped& landmark) {
  return landmark.slot != kUnknown || Existence::is_believed(landmark.status.log_odds);
}

LandmarkEstimate EkfSlam::reported(const Mapped& landmark, const LandmarkBelief& belief) const {
  const auto& [slot, status, first_seen, last_seen] = landmark;
  RangeBearing seen{.colour_class = status.colour_class};
  if (slot != kUnknown) seen = reader_.first_sighting(static_cast<std::size_t>(slot));
  return {seen.landmark_id, seen.colour_class, belief.mean, belief.covariance, status.origin};
}

Decisions EkfSlam::last_decisions() const {
  Decisions decisions{after_merging(decided_, merged_), {}};
  for (const auto& [slot, status, first_seen, last_seen] : map_) {
    if (!Existence::is_dead(status.log_odds)) decisions.mapped.push_back(status.origin);
  }
  return decisions;
}

Estimate EkfSlam::estimate_without_map() const {
  const PoseBelief now = follow(PoseBelief{belief_.pose, belief_.covariance.pose()}, motion_);
  return {.pose = now.mean, .covariance = now.covariance, .counters = counters_};
}

}  // namespace stereobench::slam
