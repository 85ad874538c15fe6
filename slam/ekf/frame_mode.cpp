#include "slam/ekf/frame_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 30;
constexpr double kConverged = 1e-8;  ///< of the cost, a chi-square: far less than any test tells
constexpr double kShortestStep = 1e-3;

/// Least difference of a frame's cost from what its slopes foresee for which it is linearised anew. A new
/// point of linearisation makes the filter surer than it may be: on the web map it has 1.45 times its bound
/// with 0, 1.18 with 0.1 and 1.14 with 0.3 and 1.
constexpr double kCurved = 0.3;

/// Where the state's parts begin: pose before, chord, landmarks.
constexpr Eigen::Index kChord = 3;
constexpr Eigen::Index kLandmarks = 6;
constexpr Eigen::Index kCertain = -1;  ///< of a landmark that has no part in it

/// The joint prior of what a frame depends on: the pose before, the motion and the landmarks seen. Landmarks
/// whose places are certain are no part of the state.
class Prior {
 public:
  Prior(const JointBelief& before, const ChordBelief& motion, std::span<const SeenLandmark> seen)
      : before_(before), motion_(motion) {
    for (const SeenLandmark& one : seen) {
      seen_.push_back(one.landmark);
      auto found = std::ranges::find(landmarks_, one.landmark);
      const bool is_certain =
          found == landmarks_.end() && before.covariance.landmark(one.landmark).isZero(0.0);
      rows_.push_back(is_certain ? kCertain : kLandmarks + 2 * (found - landmarks_.begin()));
      if (found == landmarks_.end() && !is_certain) landmarks_.push_back(one.landmark);
    }
    const auto count = static_cast<Eigen::Index>(landmarks_.size());
    covariance_ = Eigen::MatrixXd::Zero(kLandmarks + 2 * count, kLandmarks + 2 * count);
    covariance_.topLeftCorner<3, 3>() = before.covariance.pose();
    covariance_.block<3, 3>(kChord, kChord) = motion.covariance;
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        const Eigen::Matrix<double, 5, 5> both = before.covariance.between(landmark(i), landmark(j));
        const Eigen::Index row = kLandmarks + 2 * i;
        const Eigen::Index column = kLandmarks + 2 * j;
        covariance_.block<2, 2>(row, column) = both.bottomRightCorner<2, 2>();
        covariance_.block<2, 2>(column, row) = both.bottomRightCorner<2, 2>().transpose();
        if (i == j) {
          covariance_.block<2, 3>(row, 0) = both.bottomLeftCorner<2, 3>();
          covariance_.block<3, 2>(0, row) = both.bottomLeftCorner<2, 3>().transpose();
        }
      }
    }
  }

  const Eigen::MatrixXd& covariance() const { return covariance_; }

  /// Where a sighting's landmark stands in the state, or kCertain.
  Eigen::Index row_of(std::size_t sighting) const { return rows_[sighting]; }

  Pose from(const Eigen::VectorXd& shift) const { return boxplus(before_.pose, shift.head<3>()); }
  Eigen::Vector3d chord(const Eigen::VectorXd& shift) const {
    return motion_.mean + shift.segment<3>(kChord);
  }
  Eigen::Vector2d landmark_of(std::size_t sighting, const Eigen::VectorXd& shift) const {
    const Eigen::Vector2d& mean = before_.landmarks[static_cast<std::size_t>(seen_[sighting])];
    const Eigen::Index row = rows_[sighting];
    if (row == kCertain) return mean;
    return mean + shift.segment<2>(row);
  }

 private:
  int landmark(Eigen::Index i) const { return landmarks_[static_cast<std::size_t>(i)]; }

  const JointBelief& before_;
  const ChordBelief& motion_;
  std::vector<int> seen_;           ///< landmarks by sighting
  std::vector<int> landmarks_;      ///< in the state
  std::vector<Eigen::Index> rows_;  ///< by sighting
  Eigen::MatrixXd covariance_;
};

/// The sightings at some state, to first order.
struct Linear {
  Eigen::MatrixXd slope;     ///< H, by the state
  Eigen::VectorXd residual;  ///< seen less expected
  Eigen::MatrixXd noise;     ///< R, in blocks of two
};

Linear linearise(const Prior& prior, std::span<const SeenLandmark> seen, const Eigen::VectorXd& shift) {
  const auto rows = 2 * static_cast<Eigen::Index>(seen.size());
  Linear linear{Eigen::MatrixXd::Zero(rows, prior.covariance().cols()), Eigen::VectorXd(rows),
                Eigen::MatrixXd::Zero(rows, rows)};
  const Pose from = prior.from(shift);
  const Eigen::Vector3d chord = prior.chord(shift);
  const Pose robot = end_of(from, chord);
  Eigen::Matrix3d by_from = Eigen::Matrix3d::Identity();
  by_from.topRightCorner<2, 1>() = heading_lever(from, {robot.x_m, robot.y_m});
  const Eigen::Matrix3d by_chord = end_by_chord(from, chord);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const LinearSighting sighting = linearise_sighting(robot, prior.landmark_of(i, shift));
    const auto row = 2 * static_cast<Eigen::Index>(i);
    linear.slope.block<2, 3>(row, 0) = sighting.by_pose() * by_from;
    linear.slope.block<2, 3>(row, kChord) = sighting.by_pose() * by_chord;
    if (prior.row_of(i) != kCertain) linear.slope.block<2, 2>(row, prior.row_of(i)) = sighting.by_landmark;
    linear.residual.segment<2>(row) = sighting_residual(seen[i].observation.range_bearing, sighting.expected);
    linear.noise.block<2, 2>(row, row) = noise_at(seen[i].observation, sighting.expected);
  }
  return linear;
}

/// A guess of the state, and the sightings there.
struct Guess {
  /// The shift before the prior's covariance is multiplied to it, which a singular covariance could not give
  /// back.
  Eigen::VectorXd multipliers;
  Eigen::VectorXd shift;  ///< from the prior's mean
  Linear linear;
  double cost = 0.0;  ///< minus twice the log posterior, up to a constant
};

/// Squared Mahalanobis length of all residuals together.
double cost_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& noise) {
  double cost = 0.0;
  for (Eigen::Index row = 0; row < residual.size(); row += 2) {
    long repairs = 0;
    cost += Factor2(noise.block<2, 2>(row, row), repairs).squared_length(residual.segment<2>(row));
  }
  return cost;
}

Guess guess_at(const Prior& prior, std::span<const SeenLandmark> seen, const Eigen::VectorXd& multipliers) {
  const Eigen::VectorXd shift = prior.covariance() * multipliers;
  Linear linear = linearise(prior, seen, shift);
  const double cost = multipliers.dot(shift) + cost_of(linear.residual, linear.noise);
  return {multipliers, shift, std::move(linear), cost};
}

/// By how much another guess costs more or less than the slopes of this one foresee.
double bend_between(const Guess& guess, const Guess& other) {
  const auto& [slope, residual, noise] = guess.linear;
  const Eigen::VectorXd foreseen = residual - slope * (other.shift - guess.shift);
  return std::abs(other.multipliers.dot(other.shift) + cost_of(foreseen, noise) - other.cost);
}

/// Goes all the way to what is wanted, or half of it, or a quarter, until that lowers the cost.
/// @return the guess itself where nothing does
Guess improved(const Guess& guess, const Eigen::VectorXd& wanted, const Prior& prior,
               std::span<const SeenLandmark> seen) {
  for (double part = 1.0; part >= kShortestStep; part *= 0.5) {
    Guess next = guess_at(prior, seen, guess.multipliers + part * (wanted - guess.multipliers));
    if (next.cost < guess.cost) return next;
  }
  return guess;
}

/// By sighting: l' [S^-1]_ii^-1 l, where l are its two numbers of S^-1 v.
std::vector<double> squared_lengths_of(const Eigen::LLT<Eigen::MatrixXd>& root,
                                       const Eigen::VectorXd& multipliers) {
  const Eigen::MatrixXd inverse =
      root.solve(Eigen::MatrixXd::Identity(multipliers.size(), multipliers.size()));
  std::vector<double> lengths;
  for (Eigen::Index row = 0; row < multipliers.size(); row += 2) {
    long repairs = 0;
    lengths.push_back(
        Factor2(inverse.block<2, 2>(row, row), repairs).squared_length(multipliers.segment<2>(row)));
  }
  return lengths;
}

}  // namespace

std::optional<FrameMode> frame_mode(const JointBelief& before, const ChordBelief& motion,
                                    std::span<const SeenLandmark> seen) {
  if (seen.empty()) return FrameMode{before.pose, motion.mean, {}, {}};
  const Prior prior(before, motion, seen);
  Guess guess = guess_at(prior, seen, Eigen::VectorXd::Zero(prior.covariance().cols()));
  double bend = 0.0;
  for (int step = 0;; ++step) {
    const auto& [slope, residual, noise] = guess.linear;
    const Eigen::LLT<Eigen::MatrixXd> root(slope * prior.covariance() * slope.transpose() + noise);
    if (root.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd solved = root.solve(residual + slope * guess.shift);
    const Eigen::VectorXd wanted = slope.transpose() * solved;
    if (step == 0) bend = bend_between(guess, guess_at(prior, seen, wanted));
    const bool stays = step == 0 ? bend < kCurved : step == kMostSteps;
    const double cost = guess.cost;
    if (!stays) guess = improved(guess, wanted, prior, seen);
    // A prior that rounding made indefinite can cost less than nothing.
    if (!stays && cost - guess.cost > kConverged * (1.0 + std::abs(guess.cost))) continue;
    FrameMode mode{
        prior.from(guess.shift), prior.chord(guess.shift), {}, squared_lengths_of(root, solved), bend};
    for (std::size_t i = 0; i < seen.size(); ++i) mode.landmarks.push_back(prior.landmark_of(i, guess.shift));
    return mode;
  }
}

JointBelief predict_at(const FrameMode& mode, JointBelief before, const ChordBelief& motion) {
  const Pose robot = end_of(mode.from, mode.chord);
  const Eigen::Vector2d swing = heading_lever(mode.from, {robot.x_m, robot.y_m});
  const Eigen::Matrix3d by_chord = end_by_chord(mode.from, mode.chord);
  const Eigen::Vector3d off = boxminus(before.pose, mode.from);
  Eigen::Vector3d shift = off + by_chord * (motion.mean - mode.chord);
  shift.head<2>() += swing * off.z();
  before.pose = boxplus(robot, shift);
  before.covariance.move_pose(swing, by_chord * motion.covariance * by_chord.transpose());
  return before;
}

}  // namespace stereobench::slam
