#include "slam/fastslam/frame_fit.h"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "slam/fastslam/frame_update.h"
#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 30;
constexpr double kConverged = 1e-4;   ///< of the cost, a chi-square, that a step would save
constexpr int kRelinearisations = 2;  ///< by sigma points around the mode

/// The frame, and what is known before it.
struct FitProblem {
  const Pose& from;
  const ChordBelief& motion;
  Eigen::Matrix3d root;  ///< of the motion's covariance
  std::span<const Match> matches;

  Eigen::Vector3d chord_at(const Eigen::Vector3d& u) const { return motion.mean + root * u; }
  Pose pose_at(const Eigen::Vector3d& u) const { return end_of(from, chord_at(u)); }
  Eigen::Matrix3d pose_by_u(const Eigen::Vector3d& u) const { return end_by_chord(from, chord_at(u)) * root; }
};

/// Minus twice the log posterior around a point, to second order in u.
struct Expansion {
  Eigen::Vector3d u;
  std::vector<LinearMatch> matches;
  double cost = 0.0;
  double log_det_2_pi = 0.0;  ///< of all noise
  Eigen::Vector3d gradient;   ///< half of it
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

Expansion expand(const Eigen::Vector3d& u, std::vector<LinearMatch> matches, long& repairs) {
  Expansion sum{.u = u, .cost = u.squaredNorm(), .gradient = u};
  for (const LinearMatch& match : matches) {
    const Factor2 factor(match.noise, repairs);
    const Eigen::Matrix<double, 3, 2> weighted = factor.divide<3>(match.by_u.transpose());
    sum.cost += factor.squared_length(match.residual);
    sum.log_det_2_pi += factor.log_det_2_pi();
    sum.gradient -= weighted * match.residual;
    sum.information += weighted * match.by_u;
  }
  sum.matches = std::move(matches);
  return sum;
}

/// The matches by their slopes at u.
std::vector<LinearMatch> by_slopes(const FitProblem& problem, const Eigen::Vector3d& u) {
  std::vector<LinearMatch> linear;
  linear.reserve(problem.matches.size());
  const Pose pose = problem.pose_at(u);
  const Eigen::Matrix3d pose_by_u = problem.pose_by_u(u);
  for (const auto& [landmark, observation] : problem.matches) {
    const LinearSighting sighting = linearise_sighting(pose, landmark.mean);
    const auto& [expected, by_landmark] = sighting;
    linear.push_back(
        {expected, sighting_residual(observation.range_bearing, expected), sighting.by_pose() * pose_by_u,
         by_landmark * landmark.covariance * by_landmark.transpose() + noise_at(observation, expected)});
  }
  return linear;
}

/// The matches by straight lines through sigma points of the pose and of each landmark.
///
/// @param of_u covariance of u, which the points are drawn from
std::vector<LinearMatch> by_sigma_points(const Unscented& model, const FitProblem& problem,
                                         const Eigen::Vector3d& u, const Eigen::Matrix3d& of_u,
                                         long& repairs) {
  const Eigen::Matrix3d root_of_u = of_u.llt().matrixL();
  const PoseRoot root(problem.pose_by_u(u) * root_of_u);
  const PoseBelief pose{problem.pose_at(u), root.matrix() * root.matrix().transpose()};
  std::vector<LinearMatch> linear;
  linear.reserve(problem.matches.size());
  for (const auto& [landmark, observation] : problem.matches) {
    const PredictedMeasurement seen = model.expect(pose, landmark, observation, repairs);
    // With of_u = L L' and the slope A, W = L' A'.
    const Eigen::Matrix<double, 3, 2> w = root.divide(seen.cross);
    const Eigen::Matrix<double, 3, 2> slope = root_of_u.transpose().triangularView<Eigen::Upper>().solve(w);
    linear.push_back({seen.expected, sighting_residual(observation.range_bearing, seen.expected),
                      slope.transpose(), seen.covariance - w.transpose() * w});
  }
  return linear;
}

/// Goes to the mode of the matches as they are linearised. The gradient is of no more use.
void take_last_step(Expansion& around, const Eigen::LLT<Eigen::Matrix3d>& factor) {
  const Eigen::Vector3d step = -factor.solve(around.gradient);
  around.cost += step.dot(around.gradient);
  around.u += step;
  for (LinearMatch& match : around.matches) {
    match.expected += match.by_u * step;
    match.residual -= match.by_u * step;
  }
}

void relinearise_by_sigma_points(const Linearised&, const FitProblem&, Expansion&,
                                 Eigen::LLT<Eigen::Matrix3d>&, long&) {}

/// Linearises the matches as they are over the whole posterior, and not at its mode alone.
void relinearise_by_sigma_points(const Unscented& model, const FitProblem& problem, Expansion& around,
                                 Eigen::LLT<Eigen::Matrix3d>& factor, long& repairs) {
  for (int i = 0; i < kRelinearisations; ++i) {
    const Eigen::Matrix3d of_u = factor.solve(Eigen::Matrix3d::Identity());
    around = expand(around.u, by_sigma_points(model, problem, around.u, of_u, repairs), repairs);
    factor.compute(around.information);
    take_last_step(around, factor);
  }
}

/// @return around the mode of the matches by their slopes
Expansion find_mode(const FitProblem& problem, long& repairs) {
  const auto at = [&](const Eigen::Vector3d& u) { return expand(u, by_slopes(problem, u), repairs); };
  Expansion around = at(Eigen::Vector3d::Zero());
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector3d step = -around.information.llt().solve(around.gradient);
    if (!(-step.dot(around.gradient) > kConverged)) break;
    around = at(around.u + step);
  }
  return around;
}

}  // namespace

template <class Model>
FrameFit fit_frame(const Model& model, const Pose& from, const ChordBelief& motion,
                   std::span<const Match> matches, long& repairs) {
  const FitProblem problem{from, motion, semidefinite_root<3>(motion.covariance, repairs), matches};
  Expansion around = find_mode(problem, repairs);
  Eigen::LLT<Eigen::Matrix3d> factor(around.information);
  take_last_step(around, factor);
  relinearise_by_sigma_points(model, problem, around, factor, repairs);
  const Eigen::Matrix3d of_u = factor.solve(Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d covariance = problem.root * of_u * problem.root.transpose();
  const double log_det = 2.0 * logarithm(factor.matrixLLT().diagonal().prod());
  return {around.u,
          of_u,
          {problem.chord_at(around.u), 0.5 * (covariance + covariance.transpose())},
          -0.5 * (around.cost + around.log_det_2_pi + log_det),
          std::move(around.matches)};
}

template FrameFit fit_frame(const Linearised&, const Pose&, const ChordBelief&, std::span<const Match>,
                            long&);
template FrameFit fit_frame(const Unscented&, const Pose&, const ChordBelief&, std::span<const Match>, long&);

double squared_length_without(const FrameFit& fit, std::size_t match) {
  // r' Q^-1 r, where r is what the mode leaves of the sighting and Q = R - H P H' its covariance, is the same
  // number as v' S^-1 v of the innovation v from all but the sighting.
  const LinearMatch& at = fit.matches[match];
  long repairs = 0;  // for a comparison only
  return Factor2(at.noise - at.by_u * fit.of_u * at.by_u.transpose(), repairs).squared_length(at.residual);
}

std::vector<ExpectedSighting> expected_in_turn(const FrameFit& fit) {
  std::vector<ExpectedSighting> expected;
  expected.reserve(fit.matches.size());
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  long repairs = 0;  // for a report only
  for (const LinearMatch& at : fit.matches) {
    const Eigen::Matrix<double, 3, 2> cross = covariance * at.by_u.transpose();
    const Eigen::Vector2d before = at.by_u * (u - fit.u);
    const Eigen::Matrix2d seen = at.by_u * cross + at.noise;
    const Factor2 factor(seen, repairs);
    const Eigen::Vector2d residual = at.residual - before;
    expected.push_back(
        {true, at.expected + before, seen, -0.5 * (factor.squared_length(residual) + factor.log_det_2_pi())});
    const Eigen::Matrix<double, 3, 2> gain = factor.divide<3>(cross);
    u += gain * residual;
    covariance -= gain * cross.transpose();
  }
  return expected;
}

}  // namespace stereobench::slam
