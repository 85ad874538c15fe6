#include "slam/block/block_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/association/landmark_search.h"
#include "slam/block/landmark_draw.h"
#include "slam/fastslam/mixture.h"
#include "slam/fastslam/predictive_mixture.h"
#include "slam/fastslam/resampling.h"
#include "slam/math/moments.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

/// By how much a pose may turn out to be elsewhere than predicted, in standard deviations.
constexpr double kFar = 4.0;

/// By how much the straight way from a block's start may be bent, as a share of a range's standard deviation.
/// Where the heading is off by a, its end lies a^2 / 2 of its length off the tangent that the EKF takes.
constexpr double kMostBent = 0.3;

/// A block's EKF leaves no reports of its own.
FilterConfig within_block(FilterConfig config) {
  config.report_updates = false;
  config.merge_doubles = false;  // landmarks keep their places
  return config;
}

}  // namespace

BlockSlam::BlockSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed,
                     Linearisation linearisation)
    : config_(config),
      policy_(config),
      by_sigma_points_(linearisation == Linearisation::kSigmaPoints),
      unscented_(config.unscented),
      reader_(config),
      random_(seed, Stream::kFilter),
      hypotheses_(1,
                  Hypothesis{{start, {}, {}}, EkfSlam(within_block(config), start, linearisation), {}, {}}),
      log_weights_(hypotheses_.size()),
      weights_(hypotheses_.size()),
      belief_{start, Eigen::Matrix3d::Zero()},
      effective_(static_cast<double>(config.particles)) {
  make_equal(log_weights_, weights_);
}

/// A copy for a life of its own, in memory that is there already.
void BlockSlam::Hypothesis::descend_from(const Hypothesis& other) {
  start = other.start.descendant();
  now = other.now;
  shown = other.shown;
  frames = other.frames;
}

void BlockSlam::predict(const Control& control) {
  move(motion_, linearised_, control, config_.odometry_noise, counters_);
}

void BlockSlam::update(std::span<const RangeBearing> sightings) {
  report_ = {};
  decided_.clear();
  const std::vector<Sighting> frame = reader_.read(sightings, counters_.rejected_inputs);
  if (frame.empty()) return;
  for (Hypothesis& mine : hypotheses_) {
    take_up_known(mine, frame);
    take_up_near(mine, frame);
    use(mine, frame);
  }
  motion_ = {};
  reweigh(frame);
  decider_ = heaviest();
  const std::span<const Decision> decided = hypotheses_[decider_].now.decided();
  decided_.assign(decided.begin(), decided.end());
  if (effective_ < config_.resample_below * config_.particles) resample();
  if (!block_is_over()) return;
  if (particles_of_each() > 1)
    multiply();
  else
    std::ranges::for_each(hypotheses_, [&](Hypothesis& mine) { draw_block(mine); });
}

/// Whether poses are to be drawn: a block is long or wide, or the heading is so uncertain that its EKF takes
/// bent ways for straight, by what the heaviest particle uses of this frame.
bool BlockSlam::block_is_over() const {
  const auto is_large = [&](const Hypothesis& mine) {
    return static_cast<int>(mine.frames.size()) >= config_.draw_every || mine.shown.size() >= kMostLandmarks;
  };
  if (std::ranges::any_of(hypotheses_, is_large)) return true;
  const Hypothesis& heaviest = hypotheses_[decider_];
  const auto& [pose, landmarks, covariance] = heaviest.now.belief();
  const Pose& start = heaviest.start.pose;
  const double apart_m = Eigen::Vector2d(pose.x_m - start.x_m, pose.y_m - start.y_m).norm();
  const double bent_m = 0.5 * covariance.pose()(2, 2) * apart_m;
  return std::ranges::any_of(heaviest.frames.back().used, [&](const UsedSighting& one) {
    const Observation& seen = one.observation;
    return bent_m > kMostBent * std::sqrt(noise_at(seen, seen.range_bearing)(0, 0));
  });
}

/// Makes all particles of the one that stands for them, and draws their blocks one by one: what a block keeps
/// is large.
void BlockSlam::multiply() {
  const Hypothesis one = std::move(hypotheses_.front());
  hypotheses_.clear();
  hypotheses_.reserve(static_cast<std::size_t>(config_.particles));
  for (int i = 0; i < config_.particles; ++i) {
    hypotheses_.push_back(one);
    draw_block(hypotheses_.back());
  }
  log_weights_.resize(hypotheses_.size());
  weights_.resize(hypotheses_.size());
  make_equal(log_weights_, weights_);
}

/// Tells a particle's EKF of the landmarks whose identities a frame shows.
void BlockSlam::take_up_known(Hypothesis& mine, std::span<const Sighting> frame) const {
  for (const Sighting& sighting : frame) {
    const auto index = static_cast<std::size_t>(sighting.slot);
    if (sighting.slot == kUnknown || index >= mine.start.known.size()) continue;
    if (std::ranges::find(mine.now.map(), sighting.slot, &EkfSlam::Mapped::slot) == mine.now.map().end())
      take_up(mine, sighting.slot, mine.start.known, index);
  }
}

/// The same of those without an identity that its sightings may be of, or that should be seen.
void BlockSlam::take_up_near(Hypothesis& mine, std::span<const Sighting> frame) const {
  const JointBelief& before = mine.now.belief();
  const PoseBelief predicted =
      follow(PoseBelief{before.pose, before.covariance.pose()}, policy_.search_motion(motion_));
  std::vector<SightingPlace> places;
  for (const Sighting& sighting : frame)
    if (sighting.slot == kUnknown)
      places.emplace_back(predicted, sighting.observation, SearchReach{policy_.gate, policy_.near_m});
  if (places.empty()) return;
  const double spread_m = std::sqrt(predicted.covariance.topLeftCorner<2, 2>().trace());
  const double looks_m = policy_.existence.is_tracked() ? policy_.existence.range_m() + kFar * spread_m : 0.0;
  const Eigen::Vector2d robot(predicted.mean.x_m, predicted.mean.y_m);
  const auto may_matter = [&](const LandmarkBounds& bounds) {
    return bounds.places_m.exteriorDistance(robot) < looks_m ||
           std::ranges::any_of(places, [&](const SightingPlace& at) { return at.may_hold(bounds); });
  };
  mine.start.classed.visit(may_matter, [&](std::size_t j, const Landmark& landmark) {
    const auto& [mean, covariance] = landmark.belief;
    if (!may_matter({Eigen::AlignedBox2d(mean), covariance.trace()})) return;
    const auto is_it = [&](std::size_t i) {
      return mine.now.map()[i].slot == kUnknown && mine.shown[i].in_map == static_cast<int>(j);
    };
    for (std::size_t i = 0; i < mine.shown.size(); ++i)
      if (is_it(i)) return;
    take_up(mine, kUnknown, mine.start.classed, j);
  });
}

void BlockSlam::take_up(Hypothesis& mine, int slot, const LandmarkMap& map, std::size_t index) {
  mine.now.take_up(slot, map[index]);
  mine.shown.push_back({static_cast<int>(index), map[index].status.origin, false});
}

/// Corrects a particle's EKF by a frame, and keeps what it used for the draw of the path.
void BlockSlam::use(Hypothesis& mine, std::span<const Sighting> frame) {
  const Pose before = mine.now.belief().pose;
  mine.now.use(frame, motion_);
  FilterCounters counters = mine.now.take_counters();
  counters.gated_measurements *= particles_of_each();
  counters.refitted_frames *= particles_of_each();
  counters_ += counters;
  note_founded(mine);
  mine.frames.push_back({after_drift(motion_, before, mine.now.drift()), mine.now.used()});
}

/// Notes the landmarks that the last frame has found, or found elsewhere: what was seen before is not theirs.
void BlockSlam::note_founded(Hypothesis& mine) {
  const std::vector<EkfSlam::Mapped>& map = mine.now.map();
  for (std::size_t j = 0; j < map.size(); ++j) {
    if (j == mine.shown.size()) mine.shown.push_back({.origin = map[j].status.origin});
    Shown& shown = mine.shown[j];
    if (shown.origin == map[j].status.origin) continue;
    shown.origin = map[j].status.origin;
    shown.is_new = true;
    for (BlockFrame& frame : mine.frames)
      std::erase_if(frame.used, [&](const UsedSighting& one) { return one.landmark == static_cast<int>(j); });
  }
}

/// @return the log likelihood of the last frame; what is no number, or has no square, ends the particle
double BlockSlam::worth(const Hypothesis& mine, std::span<const Sighting> frame) {
  const auto& [pose, landmarks, covariance] = mine.now.belief();
  double sum = 0.0;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    if (mine.now.expected()[k].exists)
      sum += mine.now.expected()[k].log_likelihood;
    else if (frame[k].slot == kUnknown && policy_.existence.is_tracked())
      sum -= 0.5 * policy_.existence.cost_of_new(frame[k].observation);
  }
  const bool has_squares = std::isfinite(pose.x_m * pose.x_m + pose.y_m * pose.y_m) &&
                           std::isfinite(pose.heading_rad) && covariance.pose().allFinite();
  if (std::isfinite(sum) && has_squares) return sum;
  ++counters_.covariance_repairs;
  return -std::numeric_limits<double>::infinity();
}

void BlockSlam::reweigh(std::span<const Sighting> frame) {
  if (config_.report_updates) {
    std::vector<Target> targets;
    std::vector<ExpectedSighting> expected;
    for (const Hypothesis& mine : hypotheses_) {
      targets.insert(targets.end(), mine.now.targets().begin(), mine.now.targets().end());
      expected.insert(expected.end(), mine.now.expected().begin(), mine.now.expected().end());
    }
    report_.innovations = normalised_innovations(frame, targets, expected, log_weights_);
  }
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) log_weights_[i] += worth(hypotheses_[i], frame);
  if (!normalise(log_weights_, weights_)) ++counters_.weight_collapses;
  effective_ = effective_particles(weights_) * static_cast<double>(particles_of_each());
  const Pose reference = hypotheses_[heaviest()].now.belief().pose;
  Moments<3> moments;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const JointBelief& belief = hypotheses_[i].now.belief();
    moments.add(weights_[i], boxminus(belief.pose, reference), belief.covariance.pose());
  }
  belief_ = {boxplus(reference, moments.mean()), moments.covariance()};
}

std::size_t BlockSlam::heaviest() const {
  return static_cast<std::size_t>(std::ranges::max_element(log_weights_) - log_weights_.begin());
}

void BlockSlam::resample() {
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
void BlockSlam::draw_block(Hypothesis& mine) {
  long& repairs = counters_.covariance_repairs;
  const std::vector<Eigen::Vector2d> places = draw_landmarks(mine.now.belief(), random_, repairs);
  const std::vector<Pose> path = draw_path(mine.start.pose, mine.frames, places, random_, repairs);
  write_back(mine, learn(mine, path), mine.start);
  mine.start.pose = path.back();
  mine.now.start_anew(path.back());
  mine.shown.clear();
  mine.frames.clear();
}

/// Refines the map by the block's sightings, from the poses that were drawn.
/// @return by landmark of the block
std::vector<LandmarkBelief> BlockSlam::learn(const Hypothesis& mine, std::span<const Pose> path) {
  long& repairs = counters_.covariance_repairs;
  std::vector<LandmarkBelief> learnt(mine.shown.size());
  std::vector<bool> exists(mine.shown.size(), false);
  for (std::size_t j = 0; j < learnt.size(); ++j) {
    if (mine.shown[j].is_new) continue;
    const LandmarkMap& map = mine.now.map()[j].slot == kUnknown ? mine.start.classed : mine.start.known;
    learnt[j] = map[static_cast<std::size_t>(mine.shown[j].in_map)].belief;
    exists[j] = true;
  }
  const auto learn_by = [&](const auto& model) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      for (const auto& [landmark, observation] : mine.frames[k].used) {
        const auto j = static_cast<std::size_t>(landmark);
        learnt[j] = exists[j] ? model.refine(learnt[j], path[k], observation, repairs)
                              : model.found(path[k], observation, repairs);
        exists[j] = true;
      }
    }
  };
  if (by_sigma_points_)
    learn_by(unscented_);
  else
    learn_by(linearised_);
  return learnt;
}

/// @param learnt by landmark of the block
/// @param particle whose map receives them
void BlockSlam::write_back(const Hypothesis& mine, std::span<const LandmarkBelief> learnt,
                           Particle& particle) {
  for (std::size_t j = 0; j < learnt.size(); ++j) {
    const auto& [slot, status, first_seen, last_seen] = mine.now.map()[j];
    LandmarkMap& map = slot == kUnknown ? particle.classed : particle.known;
    if (mine.shown[j].in_map == kUnknown)
      map.push_back({learnt[j], status});
    else
      map.replace(static_cast<std::size_t>(mine.shown[j].in_map), {learnt[j], status});
  }
}

/// @return a particle's pose and map as its block leaves them, as if nothing tied them together
Particle BlockSlam::present(const Hypothesis& mine) {
  Particle particle = mine.start.descendant();
  const JointBelief& belief = mine.now.belief();
  std::vector<LandmarkBelief> learnt;
  for (std::size_t j = 0; j < belief.landmarks.size(); ++j)
    learnt.push_back({belief.landmarks[j], belief.covariance.landmark(static_cast<int>(j))});
  write_back(mine, learnt, particle);
  particle.pose = belief.pose;
  return particle;
}

Estimate BlockSlam::estimate() const {
  Estimate estimate = estimate_without_map();
  std::vector<Particle> particles;
  for (const Hypothesis& mine : hypotheses_) particles.push_back(present(mine));
  estimate.landmarks = mixed_landmarks(particles, weights_, heaviest(), reader_, policy_.near_m);
  return estimate;
}

Decisions BlockSlam::last_decisions() const {
  return {decided_, origins_of(present(hypotheses_[decider_]))};
}

Estimate BlockSlam::estimate_without_map() const {
  const PoseBelief now = follow(belief_, motion_);
  return {.pose = now.mean,
          .covariance = now.covariance,
          .effective_particles = effective_,
          .counters = counters_};
}

}  // namespace stereobench::slam
