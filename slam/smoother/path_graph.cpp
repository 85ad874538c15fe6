#include "slam/smoother/path_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

/// Least distance of a factor's residual from what its slopes say, in standard deviations, for which it is
/// linearised anew.
constexpr double kCurved = 0.02;

/// One over the standard deviation of what is left between two landmarks that are one, 1/m.
constexpr double kSamePlaceWeight = 1e6;

constexpr int kMostSteps = 20;  ///< in a frame; the next one goes on
constexpr int kMostHalvings = 10;

/// By how much a step may raise the cost: its rounding.
constexpr double kRounding = 1e-9;
constexpr double kLeastCost = 1e-6;

/// By what share a graph grows until all of it is linearised anew. What that costs grows with the graph, and
/// so does the number of steps between: a step costs the same on average.
constexpr double kGrowth = 0.03;

Pose pose_of(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}

bool is_finite(const BayesTree::Factor& factor) {
  return factor.by_first.allFinite() && factor.by_second.allFinite() && factor.target.allFinite();
}

}  // namespace

PathGraph::PathGraph(const Pose& start) : start_(start) {}

int PathGraph::add_variable(int numbers, const Eigen::Vector3d& guess) {
  values_.push_back(guess);
  const int index = tree_.add_variable(numbers, guess);
  late_.push_back(index);
  return index;
}

void PathGraph::add_pose(const PoseBelief& motion, const Pose& guess) {
  late_.clear();
  const int from = pose_;
  const double heading_rad = from == kStart ? start_.heading_rad : value(from).z();
  const double turned_rad = wrap_angle(guess.heading_rad - heading_rad);
  pose_ = add_variable(3, {guess.x_m, guess.y_m, heading_rad + turned_rad});
  motions_.push_back({from, pose_, MotionResidual(motion)});
  add(Kind::kMotion, motions_.size() - 1);
}

int PathGraph::add_landmark(const Eigen::Vector2d& guess) {
  return add_variable(2, {guess.x(), guess.y(), 0.0});
}

void PathGraph::add_sighting(int landmark, const Observation& observation) {
  late_.push_back(landmark);
  Observation believed = observation;
  believed.noise = noise_at(observation, predict_sighting(pose_of(value(pose_)), this->landmark(landmark)));
  sightings_.push_back({pose_, landmark, SightingResidual(believed)});
  add(Kind::kSighting, sightings_.size() - 1);
}

void PathGraph::add_same_place(int one, int other) {
  late_.push_back(one);
  late_.push_back(other);
  same_places_.push_back({one, other});
  add(Kind::kSamePlace, same_places_.size() - 1);
}

void PathGraph::add(Kind kind, std::size_t index) {
  factors_.push_back({kind, index, {}});
  const std::size_t factor = factors_.size() - 1;
  const BayesTree::Factor rows = linearise(factor).factor;
  if (is_finite(rows)) {
    factors_.back().linearised = sight_of(factor);
    tree_.add(rows);
  } else {
    ++refused_;
    factors_.pop_back();
  }
}

PathGraph::Linear PathGraph::linearise(std::size_t factor) const {
  const auto& [kind, index, linearised] = factors_[factor];
  switch (kind) {
    case Kind::kMotion:
      return linearise(motions_[index]);
    case Kind::kSighting:
      return linearise(sightings_[index]);
    case Kind::kSamePlace:
      break;
  }
  const auto& [one, other] = same_places_[index];
  Linear linear;
  linear.residual.head<2>() = kSamePlaceWeight * (landmark(one) - landmark(other));
  BayesTree::Factor& rows = linear.factor;
  rows.first = one;
  rows.second = other;
  rows.rows = 2;
  rows.by_first.topLeftCorner<2, 2>() = kSamePlaceWeight * Eigen::Matrix2d::Identity();
  rows.by_second.topLeftCorner<2, 2>() = -kSamePlaceWeight * Eigen::Matrix2d::Identity();
  return linear;
}

PathGraph::Linear PathGraph::linearise(const Motion& motion) const {
  Linear linear;
  BayesTree::Factor& rows = linear.factor;
  const bool starts = motion.from == kStart;
  const Eigen::Vector3d& to = value(motion.to);
  const auto at = motion.residual.at(starts ? start_ : pose_of(value(motion.from)), pose_of(to));
  linear.residual = at.residual;
  rows.first = motion.to;
  rows.rows = 3;
  rows.by_first = at.by_to;
  rows.target = at.by_to * to - at.residual;
  if (starts) return linear;
  rows.second = motion.from;
  rows.by_second = at.by_from;
  rows.target += at.by_from * value(motion.from);
  return linear;
}

PathGraph::Linear PathGraph::linearise(const Sighted& sighted) const {
  Linear linear;
  BayesTree::Factor& rows = linear.factor;
  const Eigen::Vector3d& pose = value(sighted.pose);
  const Eigen::Vector2d place = landmark(sighted.landmark);
  const auto at = sighted.residual.at(pose_of(pose), place);
  linear.residual.head<2>() = at.residual;
  rows.first = sighted.pose;
  rows.second = sighted.landmark;
  rows.rows = 2;
  rows.by_first.topRows<2>() = at.by_pose;
  rows.by_second.topLeftCorner<2, 2>() = at.by_landmark;
  rows.target.head<2>() = at.by_pose * pose + at.by_landmark * place - at.residual;
  return linear;
}

void PathGraph::solve() {
  is_fresh_ = false;
  if (values_.size() >= renewed_from_) renew();
  for (int i = 0; i < kMostSteps; ++i) {
    const std::vector<int> changed = changed_variables();
    if (changed.empty() || !step(changed)) return;
  }
}

/// Brings all to where it belongs now, and linearises all of it there. Factors that were linearised at
/// different headings disagree on which way is ahead, and together claim to know the heading better than they
/// do.
void PathGraph::renew() {
  std::vector<int> all(values_.size());
  std::iota(all.begin(), all.end(), 0);
  catch_up(all);
  std::vector<std::size_t> factors(factors_.size());
  std::iota(factors.begin(), factors.end(), 0U);
  linearise_anew(factors);
  renewed_from_ = static_cast<std::size_t>((1.0 + kGrowth) * static_cast<double>(all.size()));
}

/// @return the variables whose values are not the tree's solution
std::vector<int> PathGraph::changed_variables() {
  std::vector<int> changed = tree_.solve(late_, kMostOfThePast);
  changed.insert(changed.end(), behind_.begin(), behind_.end());
  behind_.clear();
  std::ranges::sort(changed);
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

void PathGraph::catch_up(std::span<const int> variables) {
  const std::vector<int> changed = tree_.catch_up(variables);
  if (!changed.empty()) step(changed);
}

/// @return the factors that a change to the tree's solution may bend, each once
std::vector<std::size_t> PathGraph::concerned_by(std::span<const int> changed) const {
  std::vector<std::size_t> concerned;
  for (const int variable : changed) {
    const std::span<const int> factors = tree_.entering_at(variable);
    concerned.insert(concerned.end(), factors.begin(), factors.end());
  }
  return concerned;
}

PathGraph::Sight PathGraph::sight_of(std::size_t factor) const {
  const auto& [kind, index, linearised] = factors_[factor];
  if (kind == Kind::kSamePlace) return {};
  if (kind == Kind::kSighting) {
    const Sighted& sighted = sightings_[index];
    return {landmark(sighted.landmark) - value(sighted.pose).head<2>(), 0.0};
  }
  const Motion& motion = motions_[index];
  const Eigen::Vector3d start(start_.x_m, start_.y_m, start_.heading_rad);
  const Eigen::Vector3d& from = motion.from == kStart ? start : value(motion.from);
  const Eigen::Vector3d& to = value(motion.to);
  return {(to - from).head<2>(), 0.5 * (from.z() + to.z())};
}

/// @return its residual as its slopes say it
Eigen::Vector3d PathGraph::foreseen(std::size_t factor) const {
  const BayesTree::Factor& rows = tree_.factor(static_cast<int>(factor));
  Eigen::Vector3d residual = rows.by_first * value(rows.first) - rows.target;
  if (rows.second != BayesTree::kNone) residual += rows.by_second * value(rows.second);
  return residual;
}

/// Whether the rest of a factor's Taylor series is below kCurved by a bound.
bool PathGraph::is_as_linear(std::size_t factor) const {
  const Kind kind = factors_[factor].kind;
  if (kind == Kind::kSamePlace) return true;
  const Sight& then = factors_[factor].linearised;
  const Sight now = sight_of(factor);
  const double slope = tree_.factor(static_cast<int>(factor)).by_first.leftCols<2>().norm();
  const double moved_m = (now.apart - then.apart).norm();
  // Half the second derivatives of range and bearing, for moves below 0.4 of the range.
  if (kind == Kind::kSighting) return slope * moved_m * moved_m < kCurved * (then.apart.norm() - moved_m);
  const double turned_rad = std::abs(now.heading_rad - then.heading_rad);
  return slope * turned_rad * (moved_m + turned_rad * now.apart.norm()) < kCurved;
}

PathGraph::Residuals PathGraph::residuals_of(std::span<const std::size_t> factors) const {
  Residuals residuals;
  residuals.reserve(factors.size());
  for (const std::size_t factor : factors)
    residuals.push_back(is_as_linear(factor) ? foreseen(factor) : linearise(factor).residual);
  return residuals;
}

/// @return the squared length of all of them together
double PathGraph::cost_of(const Residuals& residuals) {
  double cost = 0.0;
  for (const Eigen::Vector3d& residual : residuals) cost += residual.squaredNorm();
  return cost;
}

/// @return those whose residuals at the present values are not what their slopes say
std::vector<std::size_t> PathGraph::curved(std::span<const std::size_t> factors,
                                           const Residuals& residuals) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if ((foreseen(factors[i]) - residuals[i]).norm() > kCurved) found.push_back(factors[i]);
  }
  return found;
}

void PathGraph::linearise_anew(std::span<const std::size_t> factors) {
  for (const std::size_t factor : factors) {
    const BayesTree::Factor rows = linearise(factor).factor;
    if (!is_finite(rows)) continue;
    factors_[factor].linearised = sight_of(factor);
    tree_.replace(static_cast<int>(factor), rows);
  }
}

/// Goes half of the way, or a quarter and so on, until that costs no more than the limit; else nowhere: a
/// later frame may know the way.
///
/// @param go (double part) moves the values
/// @return the factors that are curved there
template <class Go>
std::vector<std::size_t> PathGraph::go_part_of_the_way(const Go& go, std::span<const std::size_t> concerned,
                                                       double limit) {
  double part = 1.0;
  for (int i = 0; i < kMostHalvings; ++i) {
    go(part *= 0.5);
    const Residuals there = residuals_of(concerned);
    if (cost_of(there) <= limit) return curved(concerned, there);
  }
  go(0.0);
  return curved(concerned, residuals_of(concerned));
}

/// Takes the tree's solution, or what is on the way there and costs less, and linearises anew what is curved.
///
/// @return whether anything was
bool PathGraph::step(std::span<const int> changed) {
  const std::vector<std::size_t> concerned = concerned_by(changed);
  std::vector<Eigen::Vector3d> before;
  for (const int v : changed) before.push_back(value(v));
  const auto go = [&](double part) {
    for (std::size_t i = 0; i < changed.size(); ++i)
      value(changed[i]) = before[i] + part * (tree_.solution(changed[i]) - before[i]);
  };
  go(1.0);
  const Residuals all_the_way = residuals_of(concerned);
  std::vector<std::size_t> bent = curved(concerned, all_the_way);
  const bool was_fresh = std::exchange(is_fresh_, false);
  if (!bent.empty()) {  // else the cost is what the slopes say, and lower
    go(0.0);
    const double limit = cost_of(residuals_of(concerned)) * (1.0 + kRounding) + kLeastCost;
    if (cost_of(all_the_way) <= limit) {
      go(1.0);
    } else {
      behind_.assign(changed.begin(), changed.end());
      if (!was_fresh) {
        linearise_anew(concerned);
        is_fresh_ = true;
        return true;
      }
      bent = go_part_of_the_way(go, concerned, limit);
    }
  }
  for (const int v : changed) tree_.hold(v, value(v));
  linearise_anew(bent);
  return !bent.empty();
}

Pose PathGraph::pose() const {
  if (pose_ == kStart) return start_;
  Pose pose = pose_of(value(pose_));
  pose.heading_rad = wrap_angle(pose.heading_rad);
  return pose;
}

std::vector<Eigen::Vector3d> PathGraph::settled() const {
  std::vector<Eigen::Vector3d> settled = tree_.settled();
  for (std::size_t v = 0; v < settled.size(); ++v)
    if (settled[v] == tree_.solution(static_cast<int>(v))) settled[v] = values_[v];
  return settled;
}

Eigen::MatrixXd PathGraph::covariance(std::span<const int> landmarks) const {
  const auto size = 3 + 2 * static_cast<Eigen::Index>(landmarks.size());
  if (pose_ == kStart) return Eigen::MatrixXd::Zero(size, size);
  std::vector<int> variables{pose_};
  variables.insert(variables.end(), landmarks.begin(), landmarks.end());
  return tree_.covariance(variables);
}

}  // namespace stereobench::slam
