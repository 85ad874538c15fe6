#include "slam/fastslam/frame_fit.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr int kIterations = 8;
constexpr double kConverged = 1e-4;  // standard deviations of the prediction

/// Minus twice the log posterior around a point, to second order in u.
struct Quadratic {
  double cost = 0.0;
  double log_det_2_pi = 0.0;  ///< of all sightings' covariances
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

Quadratic expand(const Pose& pose, const Eigen::Matrix3d& root, const Eigen::Vector3d& u,
                 std::span<const Match> matches, long& repairs) {
  Quadratic sum{.cost = u.squaredNorm(), .gradient = u};
  for (const auto& [landmark, observation] : matches) {
    const LinearSighting linear = linearise_sighting(pose, landmark.mean);
    const auto& [expected, by_landmark] = linear;
    const Eigen::Matrix<double, 2, 3> by_u = linear.by_pose() * root;
    const Factor2 factor(
        by_landmark * landmark.covariance * by_landmark.transpose() + noise_at(observation, expected),
        repairs);
    const Eigen::Vector2d residual = sighting_residual(observation.range_bearing, expected);
    const Eigen::Matrix<double, 3, 2> weighted = factor.divide<3>(by_u.transpose());
    sum.cost += factor.squared_length(residual);
    sum.log_det_2_pi += factor.log_det_2_pi();
    sum.gradient -= weighted * residual;
    sum.information += weighted * by_u;
  }
  return sum;
}

}  // namespace

FrameFit fit_frame(const PoseBelief& predicted, std::span<const Match> matches, long& repairs) {
  const Eigen::Matrix3d root = semidefinite_root<3>(predicted.covariance, repairs);
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Pose pose = predicted.mean;
  Quadratic around = expand(pose, root, u, matches, repairs);
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector3d step = -around.information.ldlt().solve(around.gradient);
    u += step;
    pose = boxplus(predicted.mean, root * u);
    around = expand(pose, root, u, matches, repairs);
    if (step.norm() < kConverged) break;
  }
  const Eigen::LLT<Eigen::Matrix3d> factor(around.information);
  const Eigen::Matrix3d covariance = root * factor.solve(root.transpose());
  const double log_det = 2.0 * logarithm(factor.matrixLLT().diagonal().prod());
  const double log_likelihood = -0.5 * (around.cost + around.log_det_2_pi + log_det);
  return {{{pose, 0.5 * (covariance + covariance.transpose())}, log_likelihood, true},
          u.squaredNorm(),
          around.cost - u.squaredNorm()};
}

}  // namespace stereobench::slam
