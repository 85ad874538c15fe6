#include "slam/ekf_slam.h"

#include <algorithm>
#include <utility>

#include "slam/measurement.h"
#include "slam/motion.h"

namespace stereobench::slam {

EkfSlam::EkfSlam(const FilterConfig& config, const Pose& start)
    : config_(config),
      gate_(chi_square_2_quantile(config.gate_probability)),
      near_m_(0.5 * config.colour_spacing_m),
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
  if (frame.empty()) return;
  const PoseBelief motion = std::exchange(motion_, {});
  follow(belief_, motion);
  Decided decided = associate(frame);
  const long gated_before = counters_.gated_measurements;
  JointBelief predicted = belief_;
  correct_one_by_one(decided);
  if (counters_.gated_measurements > gated_before) {
    predicted.covariance.move_pose(Eigen::Matrix3d::Identity(), bend_covariance(motion));
    if (auto fitted = fit_at_once(predicted, decided)) {
      belief_ = *std::move(fitted);
      counters_.gated_measurements = gated_before;
      for (const std::size_t k : decided.order) decided.targets[k].fate = Fate::kUse;
      for (NormalisedInnovation& innovation : report_.innovations) innovation.refused = false;
    }
  }
  for (const std::size_t k : decided.order) learn(decided.targets[k], frame[k]);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (decided.targets[k].fate == Fate::kAdd) add(frame[k]);
  }
}

EkfSlam::Decided EkfSlam::associate(std::span<const Sighting> frame) {
  Decided decided{frame, std::vector<Target>(frame.size()), {}};
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (frame[k].slot == kUnknown) {
      find_candidates(frame[k], static_cast<int>(k), candidates);
    } else if (static_cast<std::size_t>(frame[k].slot) < landmark_of_slot_.size()) {
      decided.targets[k] = {Fate::kUse, landmark_of_slot_[static_cast<std::size_t>(frame[k].slot)]};
    }
  }
  if (!candidates.empty()) assign(candidates, near_m_ > 0.0, decided.targets);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (decided.targets[k].fate == Fate::kUse) decided.order.push_back(k);
  }
  std::ranges::sort(decided.order, {},
                    [&](std::size_t k) { return std::pair(decided.targets[k].landmark, k); });
  return decided;
}

void EkfSlam::find_candidates(const Sighting& sighting, int index, std::vector<Candidate>& candidates) {
  const Eigen::Vector2d place = locate(belief_.pose, sighting.observation.range_bearing);
  for (std::size_t j = 0; j < map_.size(); ++j) {
    if (map_[j].slot != kUnknown || map_[j].colour_class != sighting.colour_class) continue;
    const auto landmark = static_cast<int>(j);
    const JointSurprise seen =
        surprise(belief_, belief_, landmark, sighting.observation, counters_.covariance_repairs);
    const bool gated = !(seen.squared_length() <= gate_);
    if (gated && !((place - belief_.landmarks[j]).norm() < near_m_)) continue;
    candidates.push_back({index, landmark, seen.squared_length() + seen.factor.log_det_2_pi(), gated});
  }
}

void EkfSlam::correct_one_by_one(Decided& decided) {
  bool vouched = false;
  for (const std::size_t k : decided.order) {
    Target& target = decided.targets[k];
    target.fate = use(target.landmark, decided.frame[k], vouched);
    vouched |= target.fate == Fate::kUse;
  }
}

/// @param vouched whether some landmark has corrected the pose in this frame
Fate EkfSlam::use(int landmark, const Sighting& sighting, bool vouched) {
  const Observation& observation = sighting.observation;
  long& repairs = counters_.covariance_repairs;
  JointSurprise seen = surprise(belief_, belief_, landmark, observation, repairs);
  if (config_.report_updates) report_.innovations.push_back({sighting.index, seen.squared_length()});
  if (!(seen.squared_length() <= gate_)) {
    ++counters_.gated_measurements;
    const auto j = static_cast<std::size_t>(landmark);
    const bool certain = sighting.slot == kUnknown && near_m_ > 0.0;
    const Fate fate = judge_contradiction(map_[j].record, certain, vouched);
    if (fate != Fate::kUse) {
      if (config_.report_updates) report_.innovations.back().refused = true;
      return fate;
    }
    belief_.covariance.move_pose(Eigen::Matrix3d::Identity(),
                                 drift_covariance(belief_.pose, belief_.landmarks[j], observation));
    seen = surprise(belief_, belief_, landmark, observation, repairs);
  }
  correct(belief_, landmark, seen, repairs);
  return Fate::kUse;
}

/// The iterated filter (Bell and Cathey, 1993): all sightings of a frame linearised at the state that they
/// lead to.
///
/// @param predicted before the frame is used
/// @return the belief after all sightings, when no chi-square speaks against it
std::optional<JointBelief> EkfSlam::fit_at_once(const JointBelief& predicted, const Decided& decided) {
  constexpr int kIterations = 8;
  constexpr double kConverged = 1e-7;  // m and rad
  const double limit =
      chi_square_quantile(config_.gate_probability, 2.0 * static_cast<double>(decided.order.size()));
  JointBelief at = predicted;
  for (int i = 0; i < kIterations; ++i) {
    JointBelief fitted = predicted;
    double squared_length = 0.0;
    for (const std::size_t k : decided.order) {
      const int landmark = decided.targets[k].landmark;
      const JointSurprise seen =
          surprise(fitted, at, landmark, decided.frame[k].observation, counters_.covariance_repairs);
      squared_length += seen.squared_length();
      correct(fitted, landmark, seen, counters_.covariance_repairs);
    }
    const double step = displacement(fitted.pose, at.pose).norm();
    at = std::move(fitted);
    if (step < kConverged) return squared_length <= limit ? std::optional(at) : std::nullopt;
  }
  return std::nullopt;
}

void EkfSlam::learn(const Target& target, const Sighting& sighting) {
  TrackRecord& record = map_[static_cast<std::size_t>(target.landmark)].record;
  if (target.fate == Fate::kRefuse) {
    ++record.refusals;
  } else if (target.fate == Fate::kMove) {
    place(belief_, target.landmark,
          model_.found(belief_.pose, sighting.observation, counters_.covariance_repairs));
    record = {};
  } else {
    record = {record.uses + 1, 0};
  }
}

void EkfSlam::add(const Sighting& sighting) {
  const auto slot = static_cast<std::size_t>(sighting.slot);
  if (sighting.slot != kUnknown &&
      slot < landmark_of_slot_.size()) {  // seen twice in the frame that found it
    const int landmark = landmark_of_slot_[slot];
    learn({use(landmark, sighting, true), landmark}, sighting);
    return;
  }
  const LandmarkBelief found = model_.found(belief_.pose, sighting.observation, counters_.covariance_repairs);
  for (std::size_t j = 0; sighting.slot == kUnknown && j < map_.size(); ++j) {
    if (map_[j].slot != kUnknown || map_[j].colour_class != sighting.colour_class) continue;
    if (!((belief_.landmarks[j] - found.mean).norm() < near_m_)) continue;
    ++counters_.gated_measurements;  // no second landmark of this colour can be here
    return;
  }
  const auto landmark = static_cast<int>(map_.size());
  if (sighting.slot != kUnknown) landmark_of_slot_.push_back(landmark);
  map_.push_back({sighting.slot, sighting.colour_class, {}});
  place(belief_, landmark, found);
}

Estimate EkfSlam::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t j = 0; j < map_.size(); ++j) {
    LandmarkEstimate landmark{kUnknown, map_[j].colour_class, belief_.landmarks[j],
                              belief_.covariance.landmark(static_cast<int>(j))};
    if (map_[j].slot != kUnknown) {
      const RangeBearing& first = reader_.first_sighting(static_cast<std::size_t>(map_[j].slot));
      landmark.landmark_id = first.landmark_id;
      landmark.colour_class = first.colour_class;
    }
    estimate.landmarks.push_back(landmark);
  }
  return estimate;
}

Estimate EkfSlam::estimate_without_map() const {
  const PoseBelief now = follow(PoseBelief{belief_.pose, belief_.covariance.pose()}, motion_);
  Estimate estimate;
  estimate.pose = now.mean;
  estimate.covariance = now.covariance;
  estimate.counters = counters_;
  return estimate;
}

}  // namespace stereobench::slam
