#include "slam/block/landmark_draw.h"

#include <Eigen/Cholesky>

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

}  // namespace

std::vector<Eigen::Vector2d> draw_landmarks(const JointBelief& belief, RandomStream& random, long& repairs) {
  std::vector<Eigen::Vector2d> places = belief.landmarks;
  if (places.empty()) return places;
  const Eigen::MatrixXd covariance = belief.covariance.landmarks();
  Eigen::VectorXd normals(covariance.rows());
  for (double& normal : normals) normal = random.normal();
  const Eigen::VectorXd off = root_of(covariance, repairs) * normals;
  for (std::size_t j = 0; j < places.size(); ++j)
    places[j] += off.segment<2>(2 * static_cast<Eigen::Index>(j));
  return places;
}

}  // namespace stereobench::slam
