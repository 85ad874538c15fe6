#include "slam/fastslam/pose_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/association/contradiction.h"
#include "slam/association/frame_association.h"
#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

/// Whether a posterior and the squares that are made of it are numbers.
bool is_finite(const Posterior& posterior) {
  const Pose& pose = posterior.pose.mean;
  return std::isfinite(pose.x_m * pose.x_m + pose.y_m * pose.y_m) && std::isfinite(pose.heading_rad) &&
         posterior.pose.covariance.allFinite() && std::isfinite(posterior.log_likelihood);
}

/// A sighting's innovation, measured by what was expected.
struct Innovation {
  Innovation(const PredictedMeasurement& predicted, const Observation& observation, long& repairs)
      : expected(predicted),
        factor(predicted.covariance, repairs),
        residual(sighting_residual(observation.range_bearing, predicted.expected)),
        squared_length(factor.squared_length(residual)) {}

  double log_likelihood() const { return -0.5 * (squared_length + factor.log_det_2_pi()); }

  PredictedMeasurement expected;
  Factor2 factor;
  Eigen::Vector2d residual;
  double squared_length;
};

/// A particle's map beside its predicted pose, as the rule of association reads them.
template <class Model>
struct PredictedParticle {
  static constexpr bool kTiesLandmarks = false;
  const Particle& particle;
  const PoseBelief& predicted;
  const Model& model;
  long& repairs;

  const PoseBelief& pose() const { return predicted; }
  int landmark_of(int slot) const { return slot_in(particle, slot); }

  template <class MayMatter, class Visit>
  void visit(const MayMatter& may_matter, const Visit& visit) const {
    particle.classed.visit(may_matter, visit);
  }

  Misfit misfit(std::size_t, const Landmark& landmark, const Observation& observation) const {
    const Innovation innovation(model.expect(predicted, landmark.belief, observation, repairs), observation,
                                repairs);
    return {innovation.squared_length, -2.0 * innovation.log_likelihood()};
  }

  /// Given a particle's path its landmarks are independent, so that the pose alone ties their sightings
  /// together.
  JointInnovations innovations(std::span<const Candidate> candidates, std::span<const Sighting> frame) const {
    const Eigen::Matrix3d root = semidefinite_root<3>(predicted.covariance, repairs);
    std::vector<Pairing> pairings;
    std::vector<Eigen::Matrix<double, 2, 3>> by_error;  // of the pose, in its standard deviations
    for (const Candidate& pair : candidates) {
      const Observation& observation = frame[static_cast<std::size_t>(pair.sighting)].observation;
      const LandmarkBelief& landmark = particle.classed[static_cast<std::size_t>(pair.landmark)].belief;
      const LinearSighting linear = linearise_sighting(predicted.mean, landmark.mean);
      const auto& [expected, by_landmark] = linear;
      by_error.push_back(linear.by_pose() * root);
      pairings.push_back({sighting_residual(observation.range_bearing, expected),
                          by_error.back() * by_error.back().transpose() +
                              by_landmark * landmark.covariance * by_landmark.transpose() +
                              noise_at(observation, expected)});
    }
    const auto tie = [by_error](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
      return by_error[a] * by_error[b].transpose();
    };
    return {std::move(pairings), tie};
  }
};

ExpectedSighting expectation(const PredictedMeasurement& predicted, double log_likelihood) {
  return {true, predicted.expected, predicted.covariance, log_likelihood};
}

/// The Kalman update in gain form, K = P_xz S^-1: a singular P is nothing special, and P^-1 is never needed.
void apply(const Innovation& innovation, Posterior& posterior) {
  const Eigen::Matrix<double, 3, 2> gain = innovation.factor.template divide<3>(innovation.expected.cross);
  const Eigen::Matrix3d covariance = posterior.pose.covariance - gain * innovation.expected.cross.transpose();
  posterior.pose.mean = boxplus(posterior.pose.mean, gain * innovation.residual);
  posterior.pose.covariance = 0.5 * (covariance + covariance.transpose());
  posterior.log_likelihood += innovation.log_likelihood();
  posterior.corroborated = true;
  posterior.motion.reset();
}

/// The match that the rest of a frame speaks most against.
struct Worst {
  std::ptrdiff_t match = 0;
  double squared_length = -1.0;
};

Worst worst_of(const FrameFit& fit) {
  Worst worst;
  for (std::size_t i = 0; i < fit.matches.size(); ++i) {
    const double squared_length = squared_length_without(fit, i);
    if (!(squared_length <= worst.squared_length)) worst = {static_cast<std::ptrdiff_t>(i), squared_length};
  }
  return worst;
}

/// @param from the pose before the motion
Posterior posterior_of(const FrameFit& fit, const Pose& from) {
  const Eigen::Matrix3d slope = end_by_chord(from, fit.motion.mean);
  const Eigen::Matrix3d covariance = slope * fit.motion.covariance * slope.transpose();
  return {.pose = {end_of(from, fit.motion.mean), 0.5 * (covariance + covariance.transpose())},
          .log_likelihood = fit.log_likelihood,
          .motion = fit.motion};
}

}  // namespace

template <class Model>
PoseCorrection<Model>::PoseCorrection(const FilterConfig& config, Updates updates)
    : model_(config.unscented), updates_(updates), policy_(config), report_(config.report_updates) {}

template <class Model>
Posterior PoseCorrection<Model>::correct(const Particle& particle, const PoseBelief& predicted,
                                         const ChordBelief& motion, std::span<const Sighting> frame,
                                         std::span<Target> targets, FilterCounters& counters) {
  const PoseBelief searched = policy_.search_motion(predicted);
  const PredictedParticle<Model> belief{particle, searched, model_, counters.covariance_repairs};
  associate(policy_, belief, frame, targets, counters.joint_searches_cut);
  doubt(particle, frame, targets);
  order_by_age(targets, order_);
  if (report_) expected_.assign(frame.size(), {});
  Posterior posterior{predicted};
  const long gated_before = counters.gated_measurements;
  late_ = order_;
  oldest_fitted_.reset();
  if (updates_ == Updates::kAtOnce) use_at_once(particle, frame, targets, posterior, counters);
  if (updates_ == Updates::kIterated) fit_at_once(particle, motion, frame, targets, posterior, counters);
  for (const std::size_t k : late_) {
    const Landmark& landmark = landmark_of(particle, frame[k], targets[k]);
    posterior.corroborated |= was_fitted_by_older(k);
    const double before = posterior.log_likelihood;
    const bool contradicted = counters.gated_measurements > gated_before;
    const bool read = updates_ != Updates::kToJudge || k != late_.back() || contradicted;
    targets[k].outcome =
        use(landmark, frame[k], posterior, counters, {report_ ? &expected_[k] : nullptr, read});
    if (report_) expected_[k].log_likelihood = posterior.log_likelihood - before;
  }
  posterior.log_likelihood += log_density_of_new(frame, targets);
  if (is_finite(posterior)) return posterior;
  ++counters.covariance_repairs;
  return {predicted, -std::numeric_limits<double>::infinity(), false};
}

template <class Model>
double PoseCorrection<Model>::log_likelihood(const Particle& particle, const Pose& drawn,
                                             std::span<const Sighting> frame, std::span<const Target> targets,
                                             long& repairs) {
  if (report_) expected_.assign(frame.size(), {});
  double sum = log_density_of_new(frame, targets);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (targets[k].landmark < 0 || targets[k].outcome == Outcome::kConfirm) continue;
    const LandmarkBelief& landmark = landmark_of(particle, frame[k], targets[k]).belief;
    const Observation& observation = frame[k].observation;
    const Innovation innovation(model_.expect(drawn, landmark, observation, repairs), observation, repairs);
    const double squared_length =
        targets[k].outcome == Outcome::kUse ? innovation.squared_length : policy_.gate;
    const double log_likelihood = -0.5 * (squared_length + innovation.factor.log_det_2_pi());
    if (report_) expected_[k] = expectation(innovation.expected, log_likelihood);
    sum += log_likelihood;
  }
  return sum;
}

/// Landmarks that may be clutter are not trusted to correct the pose.
template <class Model>
void PoseCorrection<Model>::doubt(const Particle& particle, std::span<const Sighting> frame,
                                  std::span<Target> targets) const {
  if (!policy_.existence.is_tracked()) return;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (frame[k].slot != kUnknown || targets[k].outcome != Outcome::kUse) continue;
    if (!Existence::is_believed(landmark_of(particle, frame[k], targets[k]).status.log_odds))
      targets[k].outcome = Outcome::kConfirm;
  }
}

/// The log density of the sightings that were given to no landmark that is believed in; those with an
/// identity are new to all particles alike.
template <class Model>
double PoseCorrection<Model>::log_density_of_new(std::span<const Sighting> frame,
                                                 std::span<const Target> targets) const {
  if (!policy_.existence.is_tracked()) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Outcome outcome = targets[k].outcome;
    const bool of_none =
        outcome == Outcome::kAdd || outcome == Outcome::kIgnore || outcome == Outcome::kConfirm;
    if (of_none && frame[k].slot == kUnknown)
      sum -= 0.5 * policy_.existence.cost_of_new(frame[k].observation);
  }
  return sum;
}

/// @return whether a landmark older than a sighting's has corrected the pose in fit_at_once()
template <class Model>
bool PoseCorrection<Model>::was_fitted_by_older(std::size_t sighting) const {
  if (!oldest_fitted_) return false;
  return std::ranges::find(order_, *oldest_fitted_) < std::ranges::find(order_, sighting);
}

/// Uses the sightings that the prediction does not refuse, and leaves the others in late_.
template <class Model>
void PoseCorrection<Model>::use_at_once(const Particle& particle, std::span<const Sighting> frame,
                                        std::span<Target> targets, Posterior& posterior,
                                        FilterCounters& counters) {
  late_.clear();
  expectations_.clear();
  long& repairs = counters.covariance_repairs;
  for (const std::size_t k : order_) {
    const LandmarkBelief& landmark = landmark_of(particle, frame[k], targets[k]).belief;
    const Observation& observation = frame[k].observation;
    const Innovation innovation(model_.expect(posterior.pose, landmark, observation, repairs), observation,
                                repairs);
    if (innovation.squared_length <= policy_.gate) {
      expectations_.push_back({innovation.expected, innovation.residual});
      if (report_) expected_[k] = expectation(innovation.expected, innovation.log_likelihood());
    } else {
      late_.push_back(k);
    }
  }
  if (!expectations_.empty()) posterior = correct_at_once(posterior.pose, expectations_, repairs);
}

/// Fits the motion to the frame without the sightings that the others speak against, and leaves those in
/// late_.
template <class Model>
void PoseCorrection<Model>::fit_at_once(const Particle& particle, const ChordBelief& motion,
                                        std::span<const Sighting> frame, std::span<Target> targets,
                                        Posterior& posterior, FilterCounters& counters) {
  posterior.motion = motion;
  std::vector<std::size_t> used = order_;
  matches_.clear();
  for (const std::size_t k : used)
    matches_.push_back({landmark_of(particle, frame[k], targets[k]).belief, frame[k].observation});
  while (!used.empty()) {
    const FrameFit fit = fit_frame(model_, particle.pose, motion, matches_, counters.covariance_repairs);
    const Worst worst = worst_of(fit);
    if (worst.squared_length <= policy_.gate) {
      oldest_fitted_ = used.front();
      if (report_) {
        const std::vector<ExpectedSighting> expected = expected_in_turn(fit);
        for (std::size_t i = 0; i < used.size(); ++i) expected_[used[i]] = expected[i];
      }
      posterior = posterior_of(fit, particle.pose);
      break;
    }
    if (used.size() == order_.size()) ++counters.refitted_frames;
    used.erase(used.begin() + worst.match);
    matches_.erase(matches_.begin() + worst.match);
  }
  std::erase_if(late_, [&](std::size_t k) { return std::ranges::find(used, k) != used.end(); });
}

template <class Model>
Outcome PoseCorrection<Model>::use(const Landmark& landmark, const Sighting& sighting, Posterior& posterior,
                                   FilterCounters& counters, const Wanted& wanted) const {
  long& repairs = counters.covariance_repairs;
  const Observation& observation = sighting.observation;
  const long before = repairs;
  const Innovation innovation(model_.expect(posterior.pose, landmark.belief, observation, repairs),
                              observation, repairs);
  if (wanted.expected != nullptr) *wanted.expected = expectation(innovation.expected, 0.0);
  if (innovation.squared_length <= policy_.gate) {
    const bool teaches = repairs == before;  // else all is certain
    if (wanted.pose && teaches) apply(innovation, posterior);
    return Outcome::kUse;
  }
  ++counters.gated_measurements;
  const Outcome outcome =
      judge_contradiction(landmark.status.record, policy_.is_certain(sighting), posterior.corroborated);
  if (outcome == Outcome::kUse) {
    posterior.relocalised = true;
    posterior.pose.covariance += drift_covariance(posterior.pose.mean, landmark.belief.mean, observation);
    apply(Innovation(model_.expect(posterior.pose, landmark.belief, observation, repairs), observation,
                     repairs),
          posterior);
  } else {
    posterior.log_likelihood -= 0.5 * (policy_.gate + innovation.factor.log_det_2_pi());
  }
  return outcome;
}

template class PoseCorrection<Linearised>;
template class PoseCorrection<Unscented>;

}  // namespace stereobench::slam
