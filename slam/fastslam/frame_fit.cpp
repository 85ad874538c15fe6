#include "slam/fastslam/frame_fit.h"

#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 30;
constexpr double kShortestStep = 1e-3;
constexpr double kConverged = 1e-4;  ///< of the cost, a chi-square, that a step would save
constexpr int kWiderLooks = 2;       ///< how often sigma points are drawn around the mode

/// The frame, and what is known before it.
struct Question {
  const Pose& from;
  const ChordBelief& motion;
  Eigen::Matrix3d root;  ///< of the motion's covariance
  std::span<const Match> matches;

  Eigen::Vector3d chord_at(const Eigen::Vector3d& u) const { return motion.mean + root * u; }
  Pose pose_at(const Eigen::Vector3d& u) const { return end_of(from, chord_at(u)); }
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
std::vector<LinearMatch> by_slopes(const Question& asked, const Eigen::Vector3d& u) {
  std::vector<LinearMatch> linear;
  linear.reserve(asked.matches.size());
  const Pose pose = asked.pose_at(u);
  const Eigen::Matrix3d pose_by_u = end_by_chord(asked.from, asked.chord_at(u)) * asked.root;
  for (const auto& [landmark, observation] : asked.matches) {
    const LinearSighting sighting = linearise_sighting(pose, landmark.mean);
    const auto& [expected, by_landmark] = sighting;
    linear.push_back(
        {expected, sighting_residual(observation.range_bearing, expected), sighting.by_pose() * pose_by_u,
         by_landmark * landmark.covariance * by_landmark.transpose() + noise_at(observation, expected)});
  }
  return linear;
}

/// Poses at the sigma points of u, above and below along each column of the root of its covariance.
struct SigmaPoses {
  SigmaPoses(const SigmaWeights<5>& weights, const Question& asked, const Eigen::Vector3d& u,
             const Eigen::Matrix3d& root)
      : centre(asked.pose_at(u)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = weights.spread * root.col(static_cast<Eigen::Index>(i));
      above[i] = asked.pose_at(u + step);
      below[i] = asked.pose_at(u - step);
    }
  }

  Pose centre;
  std::array<Pose, 3> above;
  std::array<Pose, 3> below;
};

/// A landmark as it looks from sigma points of pose and landmark, less how it looks from their centre.
SigmaResiduals<2, 5> look_from(const SigmaPoses& poses, const LandmarkBelief& landmark,
                               const Eigen::Vector2d& at_centre, double spread, long& repairs) {
  const Eigen::Matrix2d root = semidefinite_root<2>(landmark.covariance, repairs);
  SigmaResiduals<2, 5> residuals;
  const auto look = [&](int dimension, const View& above, const View& below) {
    const Eigen::Matrix2d seen = predict_sightings(above, below);
    residuals.col(2 * dimension) = sighting_residual(seen.col(0), at_centre);
    residuals.col(2 * dimension + 1) = sighting_residual(seen.col(1), at_centre);
  };
  for (std::size_t i = 0; i < 3; ++i)
    look(static_cast<int>(i), {poses.above[i], landmark.mean}, {poses.below[i], landmark.mean});
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = spread * root.col(i);
    look(3 + i, {poses.centre, landmark.mean + step}, {poses.centre, landmark.mean - step});
  }
  return residuals;
}

/// The matches by the straight lines through sigma points of u and of each landmark.
///
/// @param root lower, of the covariance that the points of u are drawn from
std::vector<LinearMatch> by_sigma_points(const SigmaWeights<5>& weights, const Question& asked,
                                         const Eigen::Vector3d& u, const Eigen::Matrix3d& root,
                                         long& repairs) {
  const SigmaPoses poses(weights, asked, u, root);
  std::vector<LinearMatch> linear;
  linear.reserve(asked.matches.size());
  for (const auto& [landmark, observation] : asked.matches) {
    const Eigen::Vector2d at_centre = predict_sighting(poses.centre, landmark.mean);
    const auto residuals = look_from(poses, landmark, at_centre, weights.spread, repairs);
    const Eigen::Vector2d mean = sigma_mean<2, 5>(residuals, weights);
    const Eigen::Vector2d expected(at_centre.x() + mean.x(), wrap_angle(at_centre.y() + mean.y()));
    // The covariance of u with the sighting is L L' A', of which the points along L's columns give L' A'.
    const auto along = sigma_cross<3, 2, 5>(Eigen::Matrix3d::Identity(), 0, residuals, weights);
    const Eigen::Matrix<double, 3, 2> slope = root.transpose().triangularView<Eigen::Upper>().solve(along);
    const Eigen::Matrix2d off_the_line =
        sigma_covariance<2, 5>(residuals, mean, weights) - along.transpose() * along;
    linear.push_back({expected, sighting_residual(observation.range_bearing, expected), slope.transpose(),
                      off_the_line + noise_at(observation, expected)});
  }
  return linear;
}

/// Goes to the mode, where the matches are taken for linear.
void settle(Expansion& around, const Eigen::LLT<Eigen::Matrix3d>& factor) {
  const Eigen::Vector3d step = -factor.solve(around.gradient);
  around.cost += step.dot(around.gradient);
  around.u += step;
  around.gradient.setZero();
  for (LinearMatch& match : around.matches) {
    match.expected += match.by_u * step;
    match.residual -= match.by_u * step;
  }
}

void look_wider(const Linearised&, const Question&, Expansion&, Eigen::LLT<Eigen::Matrix3d>&, long&) {}

/// Linearises the matches as they are over the whole posterior, and not at its mode alone.
void look_wider(const Unscented& model, const Question& asked, Expansion& around,
                Eigen::LLT<Eigen::Matrix3d>& factor, long& repairs) {
  for (int i = 0; i < kWiderLooks; ++i) {
    const Eigen::Matrix3d of_u = factor.solve(Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d root = of_u.llt().matrixL();
    around = expand(around.u, by_sigma_points(model.weights(), asked, around.u, root, repairs), repairs);
    factor.compute(around.information);
    settle(around, factor);
  }
}

/// @return around the mode of the matches by their slopes
Expansion find_mode(const Question& asked, long& repairs) {
  const auto at = [&](const Eigen::Vector3d& u) { return expand(u, by_slopes(asked, u), repairs); };
  Expansion around = at(Eigen::Vector3d::Zero());
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector3d step = -around.information.llt().solve(around.gradient);
    if (!(-step.dot(around.gradient) > kConverged)) break;
    double part = 1.0;
    Expansion next = at(around.u + step);
    while (!(next.cost < around.cost) && part > kShortestStep) next = at(around.u + (part *= 0.5) * step);
    if (!(next.cost < around.cost)) break;
    around = std::move(next);
  }
  return around;
}

}  // namespace

template <class Model>
FrameFit fit_frame(const Model& model, const Pose& from, const ChordBelief& motion,
                   std::span<const Match> matches, long& repairs) {
  const Question asked{from, motion, semidefinite_root<3>(motion.covariance, repairs), matches};
  Expansion around = find_mode(asked, repairs);
  Eigen::LLT<Eigen::Matrix3d> factor(around.information);
  settle(around, factor);
  look_wider(model, asked, around, factor, repairs);
  const Eigen::Matrix3d of_u = factor.solve(Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d covariance = asked.root * of_u * asked.root.transpose();
  const double log_det = 2.0 * logarithm(factor.matrixLLT().diagonal().prod());
  return {around.u,
          of_u,
          {asked.chord_at(around.u), 0.5 * (covariance + covariance.transpose())},
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
