#include "slam/fastslam/frame_update.h"

#include <Eigen/Cholesky>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {

PoseRoot::PoseRoot(const Eigen::Matrix3d& root) : root_(root), by_sd_(root.rowwise().norm()) {
  for (double& number : by_sd_) number = number > 0.0 ? 1.0 / number : 0.0;
  in_sd_.compute(by_sd_.asDiagonal() * root_);
}

Eigen::Matrix<double, 3, 2> PoseRoot::divide(const Eigen::Matrix<double, 3, 2>& cross) const {
  return in_sd_.solve(by_sd_.asDiagonal() * cross);
}

Posterior correct_at_once(const PoseBelief& predicted, std::span<const Expectation> frame, long& repairs) {
  const PoseRoot root(semidefinite_root<3>(predicted.covariance, repairs));
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  Eigen::Vector3d evidence = Eigen::Vector3d::Zero();
  double cost = 0.0;
  for (const auto& [expected, residual] : frame) {
    const Eigen::Matrix<double, 3, 2> w = root.divide(expected.cross);
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
  const Eigen::Matrix3d covariance = root.matrix() * factor.solve(root.matrix().transpose());
  return {{boxplus(predicted.mean, root.matrix() * u), 0.5 * (covariance + covariance.transpose())},
          -0.5 * (cost - evidence.dot(u) + log_det),
          true};
}

}  // namespace stereobench::slam
