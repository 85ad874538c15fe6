#include "slam/block/block_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/block/joint_moments.h"
#include "slam/block/landmark_draw.h"
#include "slam/fastslam/resampling.h"
#include "slam/math/gaussian.h"
#include "slam/math/moments.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
template <class Model>
BlockSlam<Model>::BlockSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed)
    : config_(config),
      gate_(chi_square_2_quantile(config.gate_probability)),
      model_(config.unscented),
      reader_(config),
      random_(seed, Stream::kFilter),
      hypotheses_(static_cast<std::size_t>(config.particles)),
      worth_(hypotheses_.size()),
      log_weights_(hypotheses_.size()),
      weights_(hypotheses_.size()),
      sampler_(config.unscented),
      belief_{start, Eigen::Matrix3d::Zero()},
      effective_(static_cast<double>(config.particles)) {
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.start.pose = hypothesis.now.pose = start;
  make_equal(log_weights_, weights_);
}

/// A copy for a life of its own, in memory that is there already.
template <class Model>
void BlockSlam<Model>::Hypothesis::descend_from(const Hypothesis& other) {
  start = other.start.descendant();
  now = other.now;
  outcomes = other.outcomes;
}

template <class Model>
void BlockSlam<Model>::predict(const Control& control) {
  move(motion_, model_, control, config_.odometry_noise, counters_);
}

template <class Model>
void BlockSlam<Model>::update(std::span<const RangeBearing> sightings) {
  report_ = {};
  decided_.clear();
  Frame frame{{}, reader_.read(sightings, counters_.rejected_inputs)};
  const auto nameless = [](const Sighting& seen) { return seen.slot == kUnknown; };
  counters_.rejected_inputs += static_cast<long>(std::erase_if(frame.sightings, nameless));
  if (frame.sightings.empty()) return;
  frame.motion = std::exchange(motion_, {});
  std::ranges::stable_sort(frame.sightings, {}, &Sighting::slot);  // oldest landmark first
  enter(frame);
  absorb(frame);
  if (config_.report_updates)
    report_.innovations = normalised_innovations(frame.sightings, targets_, expected_, log_weights_);
  reweigh();
  note_decisions(frame.sightings);
  for (const Sighting& seen : frame.sightings)
    if (!is_mapped(seen.slot)) origins_.push_back(seen.number);
  block_.push_back(std::move(frame));
  if (effective_ < config_.resample_below * static_cast<double>(hypotheses_.size())) resample();
  const bool is_full = slots_of_block_.size() >= kMostLandmarks;
  if (is_full || static_cast<int>(block_.size()) == config_.draw_every) close_block();
}

/// Gives the landmarks that the block has not seen before their places in it: those of the map first.
template <class Model>
void BlockSlam<Model>::enter(const Frame& frame) {
  const auto last = static_cast<std::size_t>(frame.sightings.back().slot);
  if (place_of_slot_.size() <= last) place_of_slot_.resize(last + 1, -1);
  const auto enter_those = [&](bool mapped) {
    for (const Sighting& seen : frame.sightings) {
      if (place_of(seen.slot) >= 0 || is_mapped(seen.slot) != mapped) continue;
      place_of(seen.slot) = static_cast<int>(slots_of_block_.size());
      slots_of_block_.push_back(seen.slot);
    }
  };
  enter_those(true);
  known_in_block_ = slots_of_block_.size();
  enter_those(false);
}

template <class Model>
void BlockSlam<Model>::absorb(const Frame& frame) {
  const std::size_t width = frame.sightings.size();
  targets_.assign(hypotheses_.size() * width, {});
  expected_.assign(targets_.size(), {});
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    Hypothesis& mine = hypotheses_[i];
    const auto targets = std::span(targets_).subspan(i * width, width);
    follow(mine.now, frame.motion);
    worth_[i] = correct(mine, frame, targets, std::span(expected_).subspan(i * width, width));
    if (known_in_block_ < slots_of_block_.size()) add_new(mine, frame);
    for (const Target& target : targets) mine.outcomes.push_back(target.outcome);
  }
}

/// Corrects a particle by the landmarks that it knows. What is no number corrects nothing, and a likelihood
/// that is none ends the particle.
/// @return the log likelihood of the frame
template <class Model>
double BlockSlam<Model>::correct(Hypothesis& mine, const Frame& frame, std::span<Target> targets,
                                 std::span<ExpectedSighting> expected) {
  for (std::size_t place = mine.now.landmarks.size(); place < known_in_block_; ++place)
    take_up(mine, slots_of_block_[place]);
  double log_likelihood = 0.0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const Sighting& sighting = frame.sightings[k];
    if (!is_mapped(sighting.slot)) continue;
    expected[k] = use(mine, sighting, targets[k]);
    log_likelihood += expected[k].log_likelihood;
  }
  if (std::isfinite(log_likelihood)) return log_likelihood;
  ++counters_.covariance_repairs;
  return -std::numeric_limits<double>::infinity();
}

/// @return what was expected of the sighting
template <class Model>
ExpectedSighting BlockSlam<Model>::use(Hypothesis& mine, const Sighting& sighting, Target& target) {
  long& repairs = counters_.covariance_repairs;
  const long before = repairs;
  const int place = place_of(sighting.slot);
  const JointInnovation seen = innovation(model_, mine.now, place, sighting.observation, repairs);
  const Eigen::Vector2d expected = sighting.observation.range_bearing - seen.residual;
  ExpectedSighting expectation{true, expected, seen.covariance};
  const double squared_length = seen.squared_length();
  target = {squared_length <= gate_ ? Outcome::kUse : Outcome::kRefuse, sighting.slot};
  if (target.outcome == Outcome::kRefuse) ++counters_.gated_measurements;
  if (target.outcome == Outcome::kUse && repairs != before) return expectation;  // all is certain
  const double cost = target.outcome == Outcome::kUse ? squared_length : gate_;
  expectation.log_likelihood = -0.5 * (cost + seen.factor.log_det_2_pi());
  if (target.outcome == Outcome::kUse) slam::correct(mine.now, place, seen, whitened_, repairs);
  return expectation;
}

/// Puts a landmark of the map behind those of the block, where it is independent of all that is there.
template <class Model>
void BlockSlam<Model>::take_up(Hypothesis& mine, int slot) {
  const LandmarkBelief& landmark = mine.start.known[static_cast<std::size_t>(slot)].belief;
  const auto place = static_cast<int>(mine.now.landmarks.size());
  mine.now.landmarks.push_back(landmark.mean);
  mine.now.covariance.place(place, Eigen::Matrix<double, 2, 3>::Zero(), landmark.covariance,
                            counters_.covariance_repairs);
}

/// Adds the landmarks that nobody has seen before; one that is seen twice by its first sighting, then the
/// other.
template <class Model>
void BlockSlam<Model>::add_new(Hypothesis& mine, const Frame& frame) {
  long& repairs = counters_.covariance_repairs;
  for (const Sighting& sighting : frame.sightings) {
    if (is_mapped(sighting.slot)) continue;
    const int place = place_of(sighting.slot);
    if (static_cast<std::size_t>(place) == mine.now.landmarks.size()) {
      find(model_, mine.now, place, sighting.observation, repairs);
      continue;
    }
    const long before = repairs;
    const JointInnovation seen = innovation(model_, mine.now, place, sighting.observation, repairs);
    if (repairs == before)  // else all is certain
      slam::correct(mine.now, place, seen, whitened_, repairs);
  }
}

template <class Model>
void BlockSlam<Model>::reweigh() {
  for (std::size_t i = 0; i < worth_.size(); ++i) log_weights_[i] += worth_[i];
  if (!normalise(log_weights_, weights_)) ++counters_.weight_collapses;
  effective_ = effective_particles(weights_);
  const Pose reference = hypotheses_[heaviest()].now.pose;
  Moments<3> moments;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const JointBelief& belief = hypotheses_[i].now;
    moments.add(weights_[i], boxminus(belief.pose, reference), belief.covariance.pose());
  }
  belief_ = {boxplus(reference, moments.mean()), moments.covariance()};
}

template <class Model>
std::size_t BlockSlam<Model>::heaviest() const {
  return static_cast<std::size_t>(std::ranges::max_element(log_weights_) - log_weights_.begin());
}

template <class Model>
void BlockSlam<Model>::note_decisions(std::span<const Sighting> frame) {
  const std::span<const Target> targets =
      std::span(targets_).subspan(heaviest() * frame.size(), frame.size());
  decided_ = decisions_of(frame, targets, [&](const Sighting& sighting, const Target&) {
    return origins_[static_cast<std::size_t>(sighting.slot)];
  });
  std::ranges::sort(decided_, {}, &Decision::sighting);
}

template <class Model>
void BlockSlam<Model>::resample() {
  const std::vector<int> ancestors = ancestors_in_place(systematic_descendants(weights_, random_.uniform()));
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const auto from = static_cast<std::size_t>(ancestors[i]);
    if (from != i) hypotheses_[i].descend_from(hypotheses_[from]);
  }
  if (config_.report_updates) report_.ancestors = ancestors;
  make_equal(log_weights_, weights_);
  ++counters_.resamplings;
}

/// Draws the block's poses, and makes their end the next block's start.
template <class Model>
void BlockSlam<Model>::close_block() {
  steps_.resize(block_.size());
  for (std::size_t k = 0; k < block_.size(); ++k) steps_[k].motion = block_[k].motion;
  for (Hypothesis& hypothesis : hypotheses_) draw_block(hypothesis);
  for (const int slot : slots_of_block_) place_of(slot) = -1;
  slots_of_block_.clear();
  block_.clear();
}

template <class Model>
void BlockSlam<Model>::draw_block(Hypothesis& mine) {
  place_sightings(mine);
  const std::span<const Pose> path =
      sampler_.draw(mine.start.pose, steps_, random_, counters_.covariance_repairs);
  learn(mine, path);
  mine.start.pose = mine.now.pose = path.back();
  mine.now.landmarks.clear();
  mine.now.covariance.clear();
  mine.outcomes.clear();
}

/// What a particle believes of the block's sightings, of landmarks whose places are drawn.
template <class Model>
void BlockSlam<Model>::place_sightings(const Hypothesis& mine) {
  const std::vector<Eigen::Vector2d> places = draw_landmarks(mine.now, random_, counters_.covariance_repairs);
  std::size_t next = 0;
  for (std::size_t k = 0; k < block_.size(); ++k) {
    steps_[k].seen.clear();
    for (const Sighting& sighting : block_[k].sightings) {
      if (mine.outcomes[next++] == Outcome::kRefuse) continue;
      steps_[k].seen.push_back(
          {places[static_cast<std::size_t>(place_of(sighting.slot))], sighting.observation});
    }
  }
}

/// Refines the map by the block's sightings, from the poses that were drawn.
template <class Model>
void BlockSlam<Model>::learn(Hypothesis& mine, std::span<const Pose> path) {
  long& repairs = counters_.covariance_repairs;
  LandmarkMap& map = mine.start.known;
  learnt_.resize(slots_of_block_.size());
  has_learnt_.assign(slots_of_block_.size(), false);
  std::size_t next = 0;
  for (std::size_t k = 0; k < block_.size(); ++k) {
    for (const Sighting& sighting : block_[k].sightings) {
      if (mine.outcomes[next++] == Outcome::kRefuse) continue;
      const auto place = static_cast<std::size_t>(place_of(sighting.slot));
      const auto slot = static_cast<std::size_t>(sighting.slot);
      Landmark& landmark = learnt_[place];
      const bool is_new = !has_learnt_[place] && slot >= map.size();
      if (is_new) landmark = {model_.found(path[k], sighting.observation, repairs), sighting.colour_class};
      if (!has_learnt_[place] && !is_new) landmark = map[slot];
      if (!is_new) landmark.belief = model_.refine(landmark.belief, path[k], sighting.observation, repairs);
      has_learnt_[place] = true;
    }
  }
  for (std::size_t place = 0; place < slots_of_block_.size(); ++place) {
    const auto slot = static_cast<std::size_t>(slots_of_block_[place]);
    if (!has_learnt_[place]) continue;
    if (slot == map.size())
      map.push_back(learnt_[place]);
    else
      map.replace(slot, learnt_[place]);
  }
}

template <class Model>
LandmarkBelief BlockSlam<Model>::landmark(const Hypothesis& of, std::size_t slot) const {
  const int place = place_of_slot_[slot];
  if (place < 0) return of.start.known[slot].belief;
  return {of.now.landmarks[static_cast<std::size_t>(place)], of.now.covariance.landmark(place)};
}

template <class Model>
Estimate BlockSlam<Model>::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t slot = 0; slot < origins_.size(); ++slot) {
    const Eigen::Vector2d reference = landmark(hypotheses_.front(), slot).mean;
    Moments<2> moments;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const LandmarkBelief belief = landmark(hypotheses_[i], slot);
      moments.add(weights_[i], belief.mean - reference, belief.covariance);
    }
    const RangeBearing& first = reader_.first_sighting(slot);
    estimate.landmarks.push_back({first.landmark_id, first.colour_class, reference + moments.mean(),
                                  moments.covariance(), origins_[slot]});
  }
  return estimate;
}

template <class Model>
Decisions BlockSlam<Model>::last_decisions() const {
  return {decided_, origins_};
}

template <class Model>
Estimate BlockSlam<Model>::estimate_without_map() const {
  const PoseBelief now = follow(belief_, motion_);
  return {.pose = now.mean,
          .covariance = now.covariance,
          .effective_particles = effective_,
          .counters = counters_};
}

template class BlockSlam<Linearised>;
template class BlockSlam<Unscented>;

}  // namespace stereobench::slam
