#include "harness/report/ellipse.h"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "slam/math/angles.h"

namespace stereobench::harness {

std::vector<Eigen::Vector2d> ellipse_95(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance) {
  constexpr int kCorners = 48;
  if (!centre.allFinite() || !covariance.allFinite()) return {};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector2d variances = solver.eigenvalues().cwiseMax(0.0);
  const Eigen::Matrix2d axes = solver.eigenvectors() * (kChiSquare95 * variances).cwiseSqrt().asDiagonal();
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * slam::kPi * i / kCorners;
    outline.emplace_back(centre + axes * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

}  // namespace stereobench::harness
