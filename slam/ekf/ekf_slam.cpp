#include "slam/ekf/ekf_slam.h"

#include <algorithm>
#include <utility>

#include "slam/association/joint_compatibility.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

EkfSlam::EkfSlam(const FilterConfig& config, const Pose& start)
    : config_(config),
      gate_(chi_square_2_quantile(config.gate_probability)),
      near_m_(0.5 * config.colour_spacing_m),
      existence_(config.sector),
      reader_(config),
      belief_{.pose = start} {}

void EkfSlam::predict(const Control& control) {
  if (!is_valid(control)) {
    ++counters_.rejected_inputs;
    return;
  }
  const Eigen::Vector2d control_sd = standard_deviations(control, config_.odometry_noise);
  motion_ = model_.move(motion_, control, control_sd, counters_.covariance_repairs);
}

void EkfSlam::update(std::span<const RangeBearing> sightings) {
  report_ = {};
  const std::vector<Sighting> frame = reader_.read(sightings, counters_.rejected_inputs);
  decided_.clear();
  if (frame.empty()) return;
  const PoseBelief motion = std::exchange(motion_, {});
  follow(belief_, motion);
  Decided decided = associate(frame);
  const long gated_before = counters_.gated_measurements;
  JointBelief predicted = belief_;
  correct_one_by_one(decided);
  if (config_.refit && counters_.gated_measurements > gated_before) {
    predicted.covariance.move_pose(Eigen::Vector2d::Zero(), bend_covariance(motion));
    if (auto fitted = fit_at_once(predicted, decided)) {
      belief_ = *std::move(fitted);
      counters_.gated_measurements = gated_before;
      for (const std::size_t k : decided.order) decided.targets[k].outcome = Outcome::kUse;
      for (NormalisedInnovation& innovation : report_.innovations) innovation.refused = false;
    }
  }
  note_decisions(decided);
  for (Mapped& landmark : map_) landmark.claimed = false;
  for (const std::size_t k : decided.order) learn(decided.targets[k], frame[k]);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (decided.targets[k].outcome == Outcome::kAdd) decided_[k].outcome = add(frame[k]);
  }
  weaken_unseen();
}

EkfSlam::Decided EkfSlam::associate(std::span<const Sighting> frame) {
  Decided decided{frame, std::vector<Target>(frame.size()), {}};
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (frame[k].slot == kUnknown) {
      find_candidates(frame[k], static_cast<int>(k), candidates);
    } else if (static_cast<std::size_t>(frame[k].slot) < landmark_of_slot_.size()) {
      decided.targets[k] = {Outcome::kUse, landmark_of_slot_[static_cast<std::size_t>(frame[k].slot)]};
    }
  }
  if (config_.association == Association::kJoint && !(near_m_ > 0.0) && compete(candidates))
    associate_jointly(frame, candidates);
  if (!candidates.empty()) assign(candidates, near_m_ > 0.0, decided.targets);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (decided.targets[k].outcome == Outcome::kUse) decided.order.push_back(k);
  }
  std::ranges::sort(decided.order, {},
                    [&](std::size_t k) { return std::pair(decided.targets[k].landmark, k); });
  return decided;
}

void EkfSlam::find_candidates(const Sighting& sighting, int index, std::vector<Candidate>& candidates) {
  const Eigen::Vector2d place = locate(belief_.pose, sighting.observation.range_bearing);
  const double cost_of_new = existence_.cost_of_new(sighting.observation);
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].slot != kUnknown || map_[j].colour_class != sighting.colour_class) continue;
    if (Existence::is_dead(map_[j].log_odds)) continue;
    const auto landmark = static_cast<int>(j);
    const JointInnovation seen =
        innovation(belief_, landmark, sighting.observation, counters_.covariance_repairs);
    const double cost = seen.squared_length() + seen.factor.log_det_2_pi();
    const bool gated = !(seen.squared_length() <= gate_ && cost <= cost_of_new);
    if (gated && !((place - belief_.landmarks[j]).norm() < near_m_)) continue;
    candidates.push_back({index, landmark, cost, gated});
  }
}

/// Drops the candidates that do not go with the rest of the frame.
void EkfSlam::associate_jointly(std::span<const Sighting> frame, std::vector<Candidate>& candidates) {
  std::vector<Pairing> pairings;
  std::vector<JointInnovation> innovations;
  for (const Candidate& pair : candidates) {
    const Observation& observation = frame[static_cast<std::size_t>(pair.sighting)].observation;
    innovations.push_back(innovation(belief_, pair.landmark, observation, counters_.covariance_repairs));
    pairings.push_back({innovations.back().residual, innovations.back().covariance});
  }
  const Tie tie = [&](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
    return innovations[a].slope * belief_.covariance.between(candidates[a].landmark, candidates[b].landmark) *
           innovations[b].slope.transpose();
  };
  keep_joint(candidates, pairings, tie, config_.gate_probability, counters_.joint_searches_cut);
}

void EkfSlam::note_decisions(const Decided& decided) {
  for (std::size_t k = 0; k < decided.frame.size(); ++k) {
    const Target& target = decided.targets[k];
    const int origin =
        target.landmark >= 0 ? map_[static_cast<std::size_t>(target.landmark)].origin : kUnknown;
    decided_.push_back({decided.frame[k].number, target.outcome, origin});
  }
}

void EkfSlam::correct_one_by_one(Decided& decided) {
  bool corroborated = false;
  for (const std::size_t k : decided.order) {
    Target& target = decided.targets[k];
    target.outcome = use(target.landmark, decided.frame[k], corroborated);
    corroborated |= target.outcome == Outcome::kUse;
  }
}

/// @param corroborated whether some landmark has corrected the pose in this frame
Outcome EkfSlam::use(int landmark, const Sighting& sighting, bool corroborated) {
  const Observation& observation = sighting.observation;
  long& repairs = counters_.covariance_repairs;
  const long before = repairs;
  JointInnovation seen = innovation(belief_, landmark, observation, repairs);
  if (config_.report_updates) report_.innovations.push_back({sighting.index, seen.squared_length()});
  if (!(seen.squared_length() <= gate_)) {
    ++counters_.gated_measurements;
    const auto j = static_cast<std::size_t>(landmark);
    const bool certain = sighting.slot == kUnknown && near_m_ > 0.0;
    const Outcome outcome = judge_contradiction(map_[j].record, certain, corroborated);
    if (outcome != Outcome::kUse) {
      if (config_.report_updates) report_.innovations.back().refused = true;
      return outcome;
    }
    belief_.covariance.move_pose(Eigen::Vector2d::Zero(),
                                 drift_covariance(belief_.pose, belief_.landmarks[j], observation));
    seen = innovation(belief_, landmark, observation, repairs);
  }
  if (repairs == before) correct(belief_, landmark, seen, repairs);  // else all is certain: nothing is learnt
  return Outcome::kUse;
}

/// The iterated filter (Bell and Cathey, 1993): all sightings of a frame linearised at the state that they
/// lead to.
///
/// @param predicted before the frame is used
/// @return the belief after all sightings, when no chi-square speaks against it
std::optional<JointBelief> EkfSlam::fit_at_once(const JointBelief& predicted, const Decided& decided) {
  constexpr int kIterations = 8;
  constexpr double kConverged = 1e-7;  // m and rad
  const double limit = approximate_chi_square_quantile(config_.gate_probability,
                                                       2.0 * static_cast<double>(decided.order.size()));
  JointBelief at = predicted;
  const long before = counters_.covariance_repairs;
  for (int i = 0; i < kIterations; ++i) {
    JointBelief fitted = predicted;
    double squared_length = 0.0;
    for (const std::size_t k : decided.order) {
      const int landmark = decided.targets[k].landmark;
      const JointInnovation seen =
          innovation(fitted, at, landmark, decided.frame[k].observation, counters_.covariance_repairs);
      squared_length += seen.squared_length();
      correct(fitted, landmark, seen, counters_.covariance_repairs);
    }
    const double step = boxminus(fitted.pose, at.pose).norm();
    at = std::move(fitted);
    if (counters_.covariance_repairs != before) return std::nullopt;
    if (step < kConverged) return squared_length <= limit ? std::optional(at) : std::nullopt;
  }
  return std::nullopt;
}

void EkfSlam::learn(const Target& target, const Sighting& sighting) {
  Mapped& landmark = map_[static_cast<std::size_t>(target.landmark)];
  TrackRecord& record = landmark.record;
  landmark.claimed = true;
  if (target.outcome == Outcome::kRefuse) {
    record.contradict();
  } else if (target.outcome == Outcome::kMove) {
    long& repairs = counters_.covariance_repairs;
    place(belief_, target.landmark, model_.found(belief_.pose, sighting.observation, repairs), repairs);
    record = {};
    landmark.origin = sighting.number;
    landmark.log_odds = existence_.founded();
  } else {
    record.agree();
    landmark.log_odds = existence_.seen(landmark.log_odds, sighting.observation);
  }
}

/// @return kAdd, or kIgnore for what is no new landmark
Outcome EkfSlam::add(const Sighting& sighting) {
  const auto slot = static_cast<std::size_t>(sighting.slot);
  if (sighting.slot != kUnknown &&
      slot < landmark_of_slot_.size()) {  // seen twice in the frame that found it
    const int landmark = landmark_of_slot_[slot];
    learn({use(landmark, sighting, true), landmark}, sighting);
    return Outcome::kAdd;
  }
  const LandmarkBelief found = model_.found(belief_.pose, sighting.observation, counters_.covariance_repairs);
  if (sighting.slot == kUnknown && may_be_mapped(sighting, found)) {
    ++counters_.gated_measurements;  // no other landmark of this colour can be here
    return Outcome::kIgnore;
  }
  const int landmark = place_for_new();
  if (sighting.slot != kUnknown) landmark_of_slot_.push_back(landmark);
  map_.resize(std::max(map_.size(), static_cast<std::size_t>(landmark) + 1));
  map_[static_cast<std::size_t>(landmark)] = {sighting.slot,   sighting.colour_class, {},
                                              sighting.number, existence_.founded(),  true};
  place(belief_, landmark, found, counters_.covariance_repairs);
  return Outcome::kAdd;
}

/// @return whether a sighting is of no new landmark: none can be there, or it may be one that no other
/// sighting of the frame is held against. That one is then neither seen nor missed.
bool EkfSlam::may_be_mapped(const Sighting& sighting, const LandmarkBelief& found) {
  double nearest = gate_;
  Mapped* like = nullptr;
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].slot != kUnknown || map_[j].colour_class != sighting.colour_class) continue;
    if (Existence::is_dead(map_[j].log_odds)) continue;
    if ((belief_.landmarks[j] - found.mean).norm() < near_m_) return true;
    if (near_m_ > 0.0 || map_[j].claimed) continue;
    const double squared_length =
        innovation(belief_, static_cast<int>(j), sighting.observation, counters_.covariance_repairs)
            .squared_length();
    if (!(squared_length <= nearest)) continue;
    nearest = squared_length;
    like = &map_[j];
  }
  if (like != nullptr) like->claimed = true;
  return like != nullptr;
}

/// @return the index of a dead landmark, whose rows are as good as new ones, or one more than the last
int EkfSlam::place_for_new() const {
  const auto dead = std::ranges::find_if(map_, [](const Mapped& landmark) {
    return landmark.slot == kUnknown && Existence::is_dead(landmark.log_odds);
  });
  return static_cast<int>(dead - map_.begin());
}

void EkfSlam::weaken_unseen() {
  if (!existence_.is_tracked()) return;
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].slot != kUnknown || map_[j].claimed) continue;
    const LandmarkBelief there{belief_.landmarks[j], belief_.covariance.landmark(static_cast<int>(j))};
    if (existence_.should_be_seen(belief_.pose, there))
      map_[j].log_odds = existence_.unseen(map_[j].log_odds);
  }
}

Estimate EkfSlam::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].slot == kUnknown && !Existence::is_believed(map_[j].log_odds)) continue;
    LandmarkEstimate landmark{kUnknown, map_[j].colour_class, belief_.landmarks[j],
                              belief_.covariance.landmark(static_cast<int>(j)), map_[j].origin};
    if (map_[j].slot != kUnknown) {
      const RangeBearing& first = reader_.first_sighting(static_cast<std::size_t>(map_[j].slot));
      landmark.landmark_id = first.landmark_id;
      landmark.colour_class = first.colour_class;
    }
    estimate.landmarks.push_back(landmark);
  }
  return estimate;
}

Decisions EkfSlam::last_decisions() const {
  Decisions decisions{decided_, {}};
  for (const Mapped& landmark : map_) {
    if (!Existence::is_dead(landmark.log_odds)) decisions.mapped.push_back(landmark.origin);
  }
  return decisions;
}

Estimate EkfSlam::estimate_without_map() const {
  const PoseBelief now = follow(PoseBelief{belief_.pose, belief_.covariance.pose()}, motion_);
  return {.pose = now.mean, .covariance = now.covariance, .counters = counters_};
}

}  // namespace stereobench::slam
