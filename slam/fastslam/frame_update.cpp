#include "slam/fastslam/frame_update.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {

Posterior correct_at_once(const PoseBelief& predicted, std::span<const Expectation> frame, long& repairs) {
  const Eigen::Matrix3d root = semidefinite_root<3>(predicted.covariance, repairs);
  // Rows are measured in standard deviations, so that the rank does not depend on units.
  Eigen::Vector3d by_sd = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (predicted.covariance(i, i) > 0.0) by_sd[i] = 1.0 / std::sqrt(predicted.covariance(i, i));
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> in_u(by_sd.asDiagonal() * root);
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  Eigen::Vector3d evidence = Eigen::Vector3d::Zero();
  double cost = 0.0;
  for (const auto& [expected, residual] : frame) {
    const Eigen::Matrix<double, 3, 2> w = in_u.solve(by_sd.asDiagonal() * expected.cross);
    const long before = repairs;
    const Factor2 apart(expected.covariance - w.transpose() * w, repairs);  // from the pose
    if (repairs != before) continue;  // certain in some direction: it cannot be weighed against others
    const Eigen::Matrix<double, 3, 2> weighted = apart.divide<3>(w);
    information += weighted * w.transpose();
    evidence += weighted * residual;
    cost += apart.squared_length(residual) + apart.log_det_2_pi();
  }
  const Eigen::LLT<Eigen::Matrix3d> factor(information);
  const Eigen::Vector3d u = factor.solve(evidence);
  const double log_det = 2.0 * logarithm(factor.matrixLLT().diagonal().prod());
  const Eigen::Matrix3d covariance = root * factor.solve(root.transpose());
  return {{boxplus(predicted.mean, root * u), 0.5 * (covariance + covariance.transpose())},
          -0.5 * (cost - evidence.dot(u) + log_det),
          true};
}

}  // namespace stereobench::slam
