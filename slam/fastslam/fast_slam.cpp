#include "slam/fastslam/fast_slam.h"

#include <algorithm>
#include <cmath>

#include "slam/fastslam/drawn_particle.h"
#include "slam/fastslam/mixture.h"
#include "slam/fastslam/resampling.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
template <class Model>
FastSlam<Model>::FastSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed,
                          Proposal proposal, Updates updates)
    : config_(config),
      proposal_(proposal),
      updates_(proposal == Proposal::kMotion ? Updates::kToJudge : updates),
      model_(config.unscented),
      reader_(config),
      correction_(config, updates_),
      management_(config),
      random_(seed, Stream::kFilter),
      particles_(static_cast<std::size_t>(config.particles), Particle{start, {}, {}}),
      log_weights_(particles_.size()),
      weights_(particles_.size()),
      headings_(particles_.size()),
      posteriors_(particles_.size()),
      belief_{start, Eigen::Matrix3d::Zero()},
      effective_(static_cast<double>(config.particles)) {
  make_equal(log_weights_, weights_);
}

template <class Model>
void FastSlam<Model>::predict(const Control& control) {
  if (updates_ == Updates::kIterated)  // the chord says what is not linear
    move(motion_, Linearised(), control, config_.odometry_noise, counters_);
  else
    move(motion_, model_, control, config_.odometry_noise, counters_);
}

template <class Model>
void FastSlam<Model>::update(std::span<const RangeBearing> sightings) {
  report_ = {};
  const std::vector<Sighting> frame = reader_.read(sightings, counters_.rejected_inputs);
  decided_.clear();
  if (frame.empty()) return;
  const bool believed = correct(frame);
  if (believed && proposal_ == Proposal::kMotion) draw_from_motion(frame);
  if (config_.report_updates)
    report_.innovations = normalised_innovations(frame, targets_, expected_, log_weights_);
  if (believed) {
    reweigh();
  }
  note_decisions(frame);
  if (believed) {
    if (effective_ < config_.resample_below * static_cast<double>(particles_.size())) resample();
    draw_poses();
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) update_map(i, frame);
  for (std::size_t k = 0; k < frame.size(); ++k) decided_[k].outcome = targets_of(decider_)[k].outcome;
}

template <class Model>
std::span<Target> FastSlam<Model>::targets_of(std::size_t particle) {
  const std::size_t width = targets_.size() / particles_.size();
  return std::span(targets_).subspan(particle * width, width);
}

/// Keeps for the report what the particle that was just corrected or weighed expected.
template <class Model>
void FastSlam<Model>::keep_expected(std::size_t particle) {
  const std::span<const ExpectedSighting> expected = correction_.expected();
  expected_.resize(targets_.size());
  std::ranges::copy(expected, expected_.begin() + static_cast<std::ptrdiff_t>(particle * expected.size()));
}

/// @return whether any particle believed anything; if none did, the frame is as good as empty
template <class Model>
bool FastSlam<Model>::correct(std::span<const Sighting> frame) {
  targets_.resize(particles_.size() * frame.size());
  const ChordBelief motion = chord_with_slack(motion_);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    headings_[i] = sine_cosine(particles_[i].pose.heading_rad);
    const PoseBelief predicted = follow(particles_[i].pose, headings_[i], motion_);
    posteriors_[i] = correction_.correct(particles_[i], predicted, motion, frame, targets_of(i), counters_);
    if (config_.report_updates) keep_expected(i);
  }
  return std::any_of(targets_.begin(), targets_.end(), [](const Target& target) {
    return target.outcome != Outcome::kRefuse && target.outcome != Outcome::kIgnore;
  });
}

/// Draws each pose from the odometry, and weighs it by what was believed of the frame.
template <class Model>
void FastSlam<Model>::draw_from_motion(std::span<const Sighting> frame) {
  long& repairs = counters_.covariance_repairs;
  const Eigen::Matrix3d root = semidefinite_root<3>(motion_.covariance, repairs);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (posteriors_[i].relocalised) continue;
    const Pose drawn = compose(particles_[i].pose, headings_[i], boxplus(motion_.mean, root * normals()));
    posteriors_[i] = {{drawn, Eigen::Matrix3d::Zero()},
                      correction_.log_likelihood(particles_[i], drawn, frame, targets_of(i), repairs)};
    if (config_.report_updates) keep_expected(i);
  }
}

template <class Model>
void FastSlam<Model>::reweigh() {
  for (std::size_t i = 0; i < particles_.size(); ++i) log_weights_[i] += posteriors_[i].log_likelihood;
  if (!normalise(log_weights_, weights_)) ++counters_.weight_collapses;
  effective_ = effective_particles(weights_);
  belief_ = mixed_pose(posteriors_, weights_);
}

/// Before resampling, which the heaviest particle survives in its place, and before landmarks are moved.
template <class Model>
void FastSlam<Model>::note_decisions(std::span<const Sighting> frame) {
  decider_ = static_cast<std::size_t>(std::ranges::max_element(log_weights_) - log_weights_.begin());
  decided_ = decisions_of(frame, targets_of(decider_), [&](const Sighting& sighting, const Target& target) {
    return landmark_of(particles_[decider_], sighting, target).status.origin;
  });
}

template <class Model>
void FastSlam<Model>::resample() {
  const std::vector<int> ancestors = ancestors_in_place(systematic_descendants(weights_, random_.uniform()));
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const auto from = static_cast<std::size_t>(ancestors[i]);
    if (from == i) continue;
    particles_[i] = particles_[from].descendant();
    posteriors_[i] = posteriors_[from];
    std::ranges::copy(targets_of(from), targets_of(i).begin());
  }
  if (config_.report_updates) report_.ancestors = ancestors;
  make_equal(log_weights_, weights_);
  ++counters_.resamplings;
}

template <class Model>
void FastSlam<Model>::draw_poses() {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const auto& [belief, likelihood, corroborated, relocalised, motion] = posteriors_[i];
    Pose& pose = particles_[i].pose;
    long& repairs = counters_.covariance_repairs;
    if (motion) {
      pose = end_of(pose, motion->mean + semidefinite_root<3>(motion->covariance, repairs) * normals());
      continue;
    }
    pose = belief.mean;
    if (proposal_ == Proposal::kMotion && !relocalised) continue;
    pose = boxplus(belief.mean, semidefinite_root<3>(belief.covariance, repairs) * normals());
  }
  motion_ = {};
}

template <class Model>
Eigen::Vector3d FastSlam<Model>::normals() {
  Eigen::Vector3d drawn;
  for (double& normal : drawn) normal = random_.normal();
  return drawn;
}

template <class Model>
void FastSlam<Model>::update_map(std::size_t particle, std::span<const Sighting> frame) {
  const std::span<Target> targets = targets_of(particle);
  DrawnParticle<Model> mine{particles_[particle], model_, management_.existence(),
                            counters_.covariance_repairs};
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (targets[k].landmark >= 0 && targets[k].outcome != Outcome::kIgnore) mine.learn(frame[k], targets[k]);
  }
  management_.update(mine, frame, targets, counters_.gated_measurements);
}

template <class Model>
Estimate FastSlam<Model>::estimate() const {
  Estimate estimate = estimate_without_map();
  const auto heaviest = std::max_element(log_weights_.begin(), log_weights_.end()) - log_weights_.begin();
  estimate.landmarks = mixed_landmarks(particles_, weights_, static_cast<std::size_t>(heaviest), reader_,
                                       0.5 * config_.colour_spacing_m);
  return estimate;
}

template <class Model>
Decisions FastSlam<Model>::last_decisions() const {
  return {decided_, origins_of(particles_[decider_])};
}

template <class Model>
Estimate FastSlam<Model>::estimate_without_map() const {
  const PoseBelief now = follow(belief_, motion_);
  return {.pose = now.mean,
          .covariance = now.covariance,
          .effective_particles = effective_,
          .counters = counters_};
}

template class FastSlam<Linearised>;
template class FastSlam<Unscented>;

}  // namespace stereobench::slam
