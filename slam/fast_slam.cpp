#include "slam/fast_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/gaussian.h"
#include "slam/measurement.h"
#include "slam/motion.h"
#include "slam/resampling.h"

namespace stereobench::slam {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

bool is_finite(const PoseBelief& belief) {
  return std::isfinite(belief.mean.x_m) && std::isfinite(belief.mean.y_m) &&
         std::isfinite(belief.mean.heading_rad) && belief.covariance.allFinite();
}

Pose draw(const PoseBelief& belief, RandomStream& random, long& repairs) {
  const Eigen::Matrix3d root = semidefinite_root<3>(belief.covariance, repairs);
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = random.normal();
  return displace(belief.mean, root * normals);
}

/// The covariance of a drift that explains why a landmark was seen this far from where it should have been.
Eigen::Matrix3d drift_covariance(const PoseBelief& belief, const LandmarkBelief& landmark,
                                 const Observation& observation) {
  constexpr double kHeadingPerMetre_rad = 0.1;
  const double off = (locate(belief.mean, observation.range_bearing) - landmark.mean).squaredNorm();
  return Eigen::Vector3d(off, off, kHeadingPerMetre_rad * kHeadingPerMetre_rad * off).asDiagonal();
}

}  // namespace

template <class Model>
FastSlam<Model>::FastSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed)
    : config_(config),
      model_(config.unscented),
      random_(seed, Stream::kFilter),
      gate_(chi_square_2_quantile(config.gate_probability)),
      particles_(static_cast<std::size_t>(config.particles), Particle{start, {}, {}}),
      log_weights_(particles_.size(), -std::log(static_cast<double>(config.particles))),
      posteriors_(particles_.size()),
      belief_{start, Eigen::Matrix3d::Zero()},
      effective_(static_cast<double>(config.particles)) {}

template <class Model>
void FastSlam<Model>::predict(const Control& control) {
  if (!is_valid(control)) {
    ++counters_.rejected_inputs;
    return;
  }
  const Eigen::Vector2d control_sd = standard_deviations(control, config_.odometry_noise);
  motion_ = model_.move(motion_, control, control_sd, counters_.covariance_repairs);
}

template <class Model>
void FastSlam<Model>::update(std::span<const RangeBearing> sightings) {
  const std::size_t mapped = particles_.front().known.size();
  const std::vector<Sighting> frame = read(sightings);
  if (frame.empty()) return;
  targets_.assign(particles_.size() * frame.size(), kNewLandmark);
  bool worth_drawing = first_sightings_.size() > mapped;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    int* targets = targets_.data() + i * frame.size();
    posteriors_[i] = correct(particles_[i], frame, targets);
    worth_drawing |= std::any_of(targets, targets + frame.size(), [](int t) { return t != kNoLandmark; });
  }
  if (!worth_drawing) return;  // everything was refused by every particle: the motion goes on growing
  reweigh();
  if (effective_ < config_.resample_below * static_cast<double>(particles_.size())) resample();
  for (std::size_t i = 0; i < particles_.size(); ++i) redraw_map(i, frame);
  motion_ = {};
}

template <class Model>
auto FastSlam<Model>::read(std::span<const RangeBearing> sightings) -> std::vector<Sighting> {
  std::vector<Sighting> frame;
  frame.reserve(sightings.size());
  const Eigen::Vector2d floor(config_.range_floor_m, config_.bearing_floor_rad);
  for (const RangeBearing& seen : sightings) {
    if (!is_valid(seen)) {
      ++counters_.rejected_inputs;
      continue;
    }
    Sighting sighting;
    sighting.observation.range_bearing = {seen.range_m, wrap_angle(seen.bearing_rad)};
    sighting.observation.noise = seen.covariance;
    sighting.observation.noise.diagonal() += floor.cwiseAbs2();
    sighting.slot = seen.landmark_id >= 0 ? slot_for(seen) : kUnknown;
    sighting.colour_class = seen.colour_class;
    frame.push_back(sighting);
  }
  return frame;
}

template <class Model>
int FastSlam<Model>::slot_for(const RangeBearing& sighting) {
  const int next = static_cast<int>(first_sightings_.size());
  const auto [found, is_new] = slot_of_id_.emplace(sighting.landmark_id, next);
  if (is_new) first_sightings_.push_back(sighting);
  return found->second;
}

template <class Model>
auto FastSlam<Model>::correct(const Particle& particle, std::span<const Sighting> frame, int* targets) -> Posterior {
  Posterior posterior{follow(particle.pose, motion_)};
  const Posterior prior = posterior;
  associate(particle, posterior.pose, frame, targets);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const int target = targets[k];
    if (target < 0) continue;
    const bool known = frame[k].slot != kUnknown;
    const auto index = static_cast<std::size_t>(target);
    const LandmarkBelief& landmark = known ? particle.known[index] : particle.classed[index].belief;
    const bool surely = !known && config_.colour_spacing_m > 0.0;
    if (!use(landmark, frame[k].observation, surely, posterior)) targets[k] = kNoLandmark;
  }
  if (is_finite(posterior.pose) && std::isfinite(posterior.log_likelihood)) return posterior;
  ++counters_.covariance_repairs;
  posterior = prior;
  posterior.log_likelihood = kNever;
  return posterior;
}

template <class Model>
void FastSlam<Model>::associate(const Particle& particle, const PoseBelief& belief, std::span<const Sighting> frame,
                                int* targets) {
  std::vector<Candidate> candidates;
  const double near_m = 0.5 * config_.colour_spacing_m;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Sighting& sighting = frame[k];
    if (sighting.slot != kUnknown) {
      const bool mapped = static_cast<std::size_t>(sighting.slot) < particle.known.size();
      targets[k] = mapped ? sighting.slot : kNewLandmark;
      continue;
    }
    const Eigen::Vector2d place = locate(belief.mean, sighting.observation.range_bearing);
    for (std::size_t j = 0; j < particle.classed.size(); ++j) {
      if (particle.classed[j].colour_class != sighting.colour_class) continue;
      const LandmarkBelief& landmark = particle.classed[j].belief;
      const Innovation expected =
          model_.expect(belief, landmark, sighting.observation.noise, counters_.covariance_repairs);
      const Factor2 factor(expected.covariance, counters_.covariance_repairs);
      const double distance =
          factor.squared_length(sighting_residual(sighting.observation.range_bearing, expected.expected));
      const bool gated = !(distance <= gate_);
      if (gated && !((place - landmark.mean).norm() < near_m)) continue;
      candidates.push_back({static_cast<int>(k), static_cast<int>(j), distance + factor.log_det_2_pi(), gated});
    }
  }
  if (!candidates.empty()) assign(candidates, near_m > 0.0, targets);
}

template <class Model>
bool FastSlam<Model>::use(const LandmarkBelief& landmark, const Observation& observation, bool surely,
                          Posterior& posterior) {
  long& repairs = counters_.covariance_repairs;
  Innovation expected = model_.expect(posterior.pose, landmark, observation.noise, repairs);
  Factor2 factor(expected.covariance, repairs);
  Eigen::Vector2d surprise = sighting_residual(observation.range_bearing, expected.expected);
  double distance = factor.squared_length(surprise);
  if (!(distance <= gate_)) {
    ++counters_.gated_measurements;
    if (!surely) {
      posterior.log_likelihood -= 0.5 * (gate_ + factor.log_det_2_pi());
      return false;
    }
    posterior.pose.covariance += drift_covariance(posterior.pose, landmark, observation);
    expected = model_.expect(posterior.pose, landmark, observation.noise, repairs);
    factor = Factor2(expected.covariance, repairs);
    surprise = sighting_residual(observation.range_bearing, expected.expected);
    distance = factor.squared_length(surprise);
  }
  const Eigen::Matrix<double, 3, 2> gain = factor.template divide<3>(expected.cross);
  const Eigen::Matrix3d covariance = posterior.pose.covariance - gain * expected.cross.transpose();
  posterior.pose.mean = displace(posterior.pose.mean, gain * surprise);
  posterior.pose.covariance = 0.5 * (covariance + covariance.transpose());
  posterior.log_likelihood -= 0.5 * (distance + factor.log_det_2_pi());
  posterior.used_something = true;
  return true;
}

template <class Model>
void FastSlam<Model>::reweigh() {
  for (std::size_t i = 0; i < particles_.size(); ++i) log_weights_[i] += posteriors_[i].log_likelihood;
  if (!normalise(log_weights_)) ++counters_.weight_collapses;
  effective_ = effective_particles(log_weights_);
  const Pose reference = posteriors_[heaviest()].pose.mean;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double weight = std::exp(log_weights_[i]);
    const Eigen::Vector3d offset = displacement(posteriors_[i].pose.mean, reference);
    mean += weight * offset;
    second += weight * (posteriors_[i].pose.covariance + offset * offset.transpose());
  }
  belief_ = {displace(reference, mean), second - mean * mean.transpose()};
}

template <class Model>
void FastSlam<Model>::resample() {
  const std::vector<int> ancestors =
      ancestors_in_place(systematic_descendants(log_weights_, random_.uniform()));
  const std::size_t width = targets_.size() / particles_.size();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const auto from = static_cast<std::size_t>(ancestors[i]);
    if (from == i) continue;
    particles_[i] = particles_[from];
    posteriors_[i] = posteriors_[from];
    std::copy_n(targets_.data() + from * width, width, targets_.data() + i * width);
  }
  std::fill(log_weights_.begin(), log_weights_.end(), -std::log(static_cast<double>(particles_.size())));
  ++counters_.resamplings;
}

template <class Model>
void FastSlam<Model>::redraw_map(std::size_t particle, std::span<const Sighting> frame) {
  Particle& mine = particles_[particle];
  const int* targets = targets_.data() + particle * frame.size();
  long& repairs = counters_.covariance_repairs;
  mine.pose = draw(posteriors_[particle].pose, random_, repairs);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Sighting& sighting = frame[k];
    if (targets[k] < 0) continue;
    const auto index = static_cast<std::size_t>(targets[k]);
    LandmarkBelief& landmark = sighting.slot != kUnknown ? mine.known[index] : mine.classed[index].belief;
    landmark = model_.refine(landmark, mine.pose, sighting.observation, repairs);
  }
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Sighting& sighting = frame[k];
    if (targets[k] != kNewLandmark) continue;
    const auto slot = static_cast<std::size_t>(sighting.slot);
    if (sighting.slot == kUnknown) {
      add_classed(mine, sighting);
    } else if (slot < mine.known.size()) {  // the second sighting of a landmark that is new in this frame
      mine.known[slot] = model_.refine(mine.known[slot], mine.pose, sighting.observation, repairs);
    } else {
      mine.known.push_back(model_.found(mine.pose, sighting.observation, repairs));
    }
  }
}

template <class Model>
void FastSlam<Model>::add_classed(Particle& particle, const Sighting& sighting) {
  const LandmarkBelief found =
      model_.found(particle.pose, sighting.observation, counters_.covariance_repairs);
  const double near_m = 0.5 * config_.colour_spacing_m;
  const bool doubled = std::any_of(particle.classed.begin(), particle.classed.end(), [&](const auto& other) {
    return other.colour_class == sighting.colour_class && (other.belief.mean - found.mean).norm() < near_m;
  });
  if (doubled) {
    ++counters_.gated_measurements;
  } else {
    particle.classed.push_back({found, sighting.colour_class});
  }
}

template <class Model>
std::size_t FastSlam<Model>::heaviest() const {
  const auto found = std::max_element(log_weights_.begin(), log_weights_.end());
  return static_cast<std::size_t>(found - log_weights_.begin());
}

template <class Model>
LandmarkEstimate FastSlam<Model>::mixed_known(std::size_t slot) const {
  LandmarkEstimate mixed;
  mixed.landmark_id = first_sightings_[slot].landmark_id;
  mixed.colour_class = first_sightings_[slot].colour_class;
  const Eigen::Vector2d reference = particles_[heaviest()].known[slot].mean;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const LandmarkBelief& belief = particles_[i].known[slot];
    const double weight = std::exp(log_weights_[i]);
    const Eigen::Vector2d offset = belief.mean - reference;
    mean += weight * offset;
    mixed.covariance += weight * (belief.covariance + offset * offset.transpose());
  }
  mixed.position_m = reference + mean;
  mixed.covariance -= mean * mean.transpose();
  return mixed;
}

template <class Model>
LandmarkEstimate FastSlam<Model>::mixed_classed(std::size_t landmark) const {
  const ClassedLandmark& own = particles_[heaviest()].classed[landmark];
  LandmarkEstimate mixed;
  mixed.colour_class = own.colour_class;
  mixed.position_m = own.belief.mean;
  mixed.covariance = own.belief.covariance;
  return mixed;
}

template <class Model>
Estimate FastSlam<Model>::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t slot = 0; slot < particles_.front().known.size(); ++slot) {
    estimate.landmarks.push_back(mixed_known(slot));
  }
  for (std::size_t j = 0; j < particles_[heaviest()].classed.size(); ++j) {
    estimate.landmarks.push_back(mixed_classed(j));
  }
  return estimate;
}

template <class Model>
Estimate FastSlam<Model>::estimate_without_map() const {
  const PoseBelief now = follow(belief_, motion_);
  Estimate estimate;
  estimate.pose = now.mean;
  estimate.covariance = now.covariance;
  estimate.effective_particles = effective_;
  estimate.counters = counters_;
  return estimate;
}

template class FastSlam<Linearised>;
template class FastSlam<Unscented>;

}  // namespace stereobench::slam
