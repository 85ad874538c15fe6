#include "slam/block_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

#include "slam/gaussian.h"
#include "slam/joint_moments.h"
#include "slam/measurement.h"
#include "slam/moments.h"
#include "slam/motion.h"
#include "slam/resampling.h"

namespace stereobench::slam {
namespace {

/// A root of a covariance of any size, as far as rounding lets it have one.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance, long& repairs) {
  constexpr double kIndefinite = -1e-7;
  const Eigen::VectorXd sd = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd by_sd = (sd.array() > 0.0).select(sd.cwiseInverse(), 0.0);
  const Eigen::LDLT<Eigen::MatrixXd> factor(by_sd.asDiagonal() * covariance * by_sd.asDiagonal());
  if (factor.vectorD().minCoeff() < kIndefinite) ++repairs;
  const Eigen::VectorXd pivots = factor.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd lower = factor.matrixL();
  return sd.asDiagonal() * (factor.transpositionsP().transpose() * (lower * pivots.asDiagonal()));
}

bool is_finite(const JointBelief& belief) {
  const Pose& pose = belief.pose;
  return std::isfinite(pose.x_m * pose.x_m + pose.y_m * pose.y_m) && std::isfinite(pose.heading_rad) &&
         belief.covariance.pose().allFinite();
}

}  // namespace

template <class Model>
BlockSlam<Model>::BlockSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed)
    : config_(config),
      gate_(chi_square_2_quantile(config.gate_probability)),
      model_(config.unscented),
      reader_(config),
      random_(seed, Stream::kFilter),
      hypotheses_(static_cast<std::size_t>(config.particles)),
      log_weights_(hypotheses_.size()),
      weights_(hypotheses_.size()),
      belief_{start, Eigen::Matrix3d::Zero()},
      effective_(static_cast<double>(config.particles)) {
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.start.pose = hypothesis.now.pose = start;
  make_equal(log_weights_, weights_);
}

template <class Model>
int& BlockSlam<Model>::Hypothesis::in_block(int slot) {
  const auto index = static_cast<std::size_t>(slot);
  if (place_in_block.size() <= index) place_in_block.resize(index + 1, -1);
  return place_in_block[index];
}

template <class Model>
LandmarkBelief BlockSlam<Model>::Hypothesis::landmark(std::size_t slot) const {
  const int place = slot < place_in_block.size() ? place_in_block[slot] : -1;
  if (place < 0) return start.known[slot].belief;
  return {now.landmarks[static_cast<std::size_t>(place)], now.covariance.landmark(place)};
}

template <class Model>
void BlockSlam<Model>::predict(const Control& control) {
  if (!is_valid(control)) {
    ++counters_.rejected_inputs;
    return;
  }
  const Eigen::Vector2d control_sd = standard_deviations(control, config_.odometry_noise);
  motion_ = model_.move(motion_, control, control_sd, counters_.covariance_repairs);
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
  const std::vector<double> worth = absorb(frame);
  if (config_.report_updates)
    report_.innovations = normalised_innovations(frame.sightings, targets_, expected_, log_weights_);
  reweigh(worth);
  note_decisions(frame.sightings);
  for (const Sighting& seen : frame.sightings)
    if (!is_mapped(seen.slot)) origins_.push_back(seen.number);
  block_.push_back(std::move(frame));
  if (effective_ < config_.resample_below * static_cast<double>(hypotheses_.size())) resample();
  if (static_cast<int>(block_.size()) < config_.draw_every) return;
  for (Hypothesis& hypothesis : hypotheses_) close_block(hypothesis);
  block_.clear();
}

/// @return what a frame is worth to each particle, as logarithms
template <class Model>
std::vector<double> BlockSlam<Model>::absorb(const Frame& frame) {
  const std::size_t width = frame.sightings.size();
  targets_.assign(hypotheses_.size() * width, {});
  expected_.assign(targets_.size(), {});
  std::vector<double> worth;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const auto targets = std::span(targets_).subspan(i * width, width);
    follow(hypotheses_[i].now, frame.motion);
    worth.push_back(correct(hypotheses_[i], frame, targets, std::span(expected_).subspan(i * width, width)));
    add_new(hypotheses_[i], frame);
    for (const Target& target : targets) hypotheses_[i].fates.push_back(target.fate);
  }
  return worth;
}

/// Corrects a particle by the landmarks that it knows.
/// @return the log likelihood of the frame
template <class Model>
double BlockSlam<Model>::correct(Hypothesis& mine, const Frame& frame, std::span<Target> targets,
                                 std::span<ExpectedSighting> expected) {
  for (const Sighting& sighting : frame.sightings)
    if (is_mapped(sighting.slot)) take_up(mine, sighting.slot);
  before_ = mine.now;
  double log_likelihood = 0.0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const Sighting& sighting = frame.sightings[k];
    if (!is_mapped(sighting.slot)) continue;
    expected[k] = use(mine, sighting, targets[k]);
    log_likelihood += expected[k].log_likelihood;
  }
  if (is_finite(mine.now) && std::isfinite(log_likelihood)) return log_likelihood;
  ++counters_.covariance_repairs;
  mine.now = before_;
  return -std::numeric_limits<double>::infinity();
}

/// @return what was expected of the sighting
template <class Model>
ExpectedSighting BlockSlam<Model>::use(Hypothesis& mine, const Sighting& sighting, Target& target) {
  long& repairs = counters_.covariance_repairs;
  const long before = repairs;
  const int place = mine.in_block(sighting.slot);
  const JointSurprise seen = surprise(model_, mine.now, place, sighting.observation, repairs);
  const Eigen::Vector2d expected = sighting.observation.range_bearing - seen.residual;
  ExpectedSighting expectation{true, expected, seen.covariance};
  const double squared_length = seen.squared_length();
  target = {squared_length <= gate_ ? Fate::kUse : Fate::kRefuse, sighting.slot};
  if (target.fate == Fate::kRefuse) ++counters_.gated_measurements;
  if (target.fate == Fate::kUse && repairs != before) return expectation;  // all is certain
  const double cost = target.fate == Fate::kUse ? squared_length : gate_;
  expectation.log_likelihood = -0.5 * (cost + seen.factor.log_det_2_pi());
  if (target.fate == Fate::kUse) slam::correct(mine.now, place, seen, repairs);
  return expectation;
}

/// Puts a landmark of the map among those of the block, where it is independent of all that is there.
template <class Model>
void BlockSlam<Model>::take_up(Hypothesis& mine, int slot) {
  int& place = mine.in_block(slot);
  if (place >= 0) return;
  const LandmarkBelief& landmark = mine.start.known[static_cast<std::size_t>(slot)].belief;
  place = static_cast<int>(mine.now.landmarks.size());
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
    int& place = mine.in_block(sighting.slot);
    if (place >= 0) {
      const long before = repairs;
      const JointSurprise seen = surprise(model_, mine.now, place, sighting.observation, repairs);
      if (repairs == before) slam::correct(mine.now, place, seen, repairs);  // else all is certain
      continue;
    }
    place = static_cast<int>(mine.now.landmarks.size());
    find(model_, mine.now, place, sighting.observation, repairs);
  }
}

template <class Model>
void BlockSlam<Model>::reweigh(std::span<const double> worth) {
  for (std::size_t i = 0; i < worth.size(); ++i) log_weights_[i] += worth[i];
  if (!normalise(log_weights_, weights_)) ++counters_.weight_collapses;
  effective_ = effective_particles(weights_);
  const Pose reference = hypotheses_[heaviest()].now.pose;
  Moments<3> moments;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const JointBelief& belief = hypotheses_[i].now;
    moments.add(weights_[i], displacement(belief.pose, reference), belief.covariance.pose());
  }
  belief_ = {displace(reference, moments.mean()), moments.covariance()};
}

template <class Model>
std::size_t BlockSlam<Model>::heaviest() const {
  return static_cast<std::size_t>(std::ranges::max_element(log_weights_) - log_weights_.begin());
}

template <class Model>
void BlockSlam<Model>::note_decisions(std::span<const Sighting> frame) {
  const std::span<const Target> targets =
      std::span(targets_).subspan(heaviest() * frame.size(), frame.size());
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const int slot = frame[k].slot;
    const int origin = is_mapped(slot) ? origins_[static_cast<std::size_t>(slot)] : kUnknown;
    decided_.push_back({frame[k].number, targets[k].fate, origin});
  }
  std::ranges::sort(decided_, {}, &Decision::sighting);
}

template <class Model>
void BlockSlam<Model>::resample() {
  const std::vector<int> ancestors = ancestors_in_place(systematic_descendants(weights_, random_.uniform()));
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const auto from = static_cast<std::size_t>(ancestors[i]);
    if (from != i) hypotheses_[i] = hypotheses_[from].descendant();
  }
  if (config_.report_updates) report_.ancestors = ancestors;
  make_equal(log_weights_, weights_);
  ++counters_.resamplings;
}

/// Draws the block's poses, and makes their end the next block's start.
template <class Model>
void BlockSlam<Model>::close_block(Hypothesis& mine) {
  const std::vector<PathStep> steps = seen_by(mine);
  const std::vector<Pose> path =
      draw_path(model_, mine.start.pose, steps, random_, counters_.covariance_repairs);
  std::size_t next = 0;
  for (std::size_t k = 0; k < block_.size(); ++k) {
    for (const Sighting& sighting : block_[k].sightings)
      if (mine.fates[next++] != Fate::kRefuse) learn(mine.start.known, path[k], sighting);
  }
  mine.start.pose = path.back();
  mine.now = {mine.start.pose, {}, {}};
  mine.place_in_block.clear();
  mine.fates.clear();
}

/// What a particle believes of the block's sightings, of landmarks whose places are drawn.
template <class Model>
std::vector<PathStep> BlockSlam<Model>::seen_by(Hypothesis& mine) {
  const std::vector<Eigen::Vector2d> places = draw_landmarks(mine.now);
  std::vector<PathStep> steps;
  std::size_t next = 0;
  for (const Frame& frame : block_) {
    steps.push_back({frame.motion, {}});
    for (const Sighting& sighting : frame.sightings) {
      if (mine.fates[next++] == Fate::kRefuse) continue;
      const auto place = static_cast<std::size_t>(mine.in_block(sighting.slot));
      steps.back().seen.push_back({places[place], sighting.observation});
    }
  }
  return steps;
}

template <class Model>
std::vector<Eigen::Vector2d> BlockSlam<Model>::draw_landmarks(const JointBelief& belief) {
  const auto count = static_cast<int>(belief.landmarks.size());
  Eigen::MatrixXd covariance(2 * count, 2 * count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Eigen::Matrix2d block = belief.covariance.between(i, j).bottomRightCorner<2, 2>();
      covariance.block<2, 2>(2 * i, 2 * j) = block;
      covariance.block<2, 2>(2 * j, 2 * i) = block.transpose();
    }
  }
  Eigen::VectorXd normals(2 * count);
  for (double& normal : normals) normal = random_.normal();
  const Eigen::VectorXd off = root_of(covariance, counters_.covariance_repairs) * normals;
  std::vector<Eigen::Vector2d> places = belief.landmarks;
  for (int i = 0; i < count; ++i) places[static_cast<std::size_t>(i)] += off.segment<2>(2 * i);
  return places;
}

template <class Model>
void BlockSlam<Model>::learn(LandmarkMap& map, const Pose& robot, const Sighting& sighting) {
  long& repairs = counters_.covariance_repairs;
  const auto slot = static_cast<std::size_t>(sighting.slot);
  if (slot == map.size()) {
    map.push_back({model_.found(robot, sighting.observation, repairs), sighting.colour_class});
    return;
  }
  Landmark landmark = map[slot];
  landmark.belief = model_.refine(landmark.belief, robot, sighting.observation, repairs);
  map.replace(slot, landmark);
}

template <class Model>
Estimate BlockSlam<Model>::estimate() const {
  Estimate estimate = estimate_without_map();
  for (std::size_t slot = 0; slot < origins_.size(); ++slot) {
    const Eigen::Vector2d reference = hypotheses_.front().landmark(slot).mean;
    Moments<2> moments;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const LandmarkBelief belief = hypotheses_[i].landmark(slot);
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
