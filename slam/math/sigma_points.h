/// The scaled unscented transform: moments of a Gaussian through any function, angles included.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "slam/filter_config.h"

namespace stereobench::slam {

/// Spread and weights of 2N + 1 sigma points (eq. 7, 14 and 15 with lambda / (N + lambda)).
template <int kDimension>
struct SigmaWeights {
  explicit SigmaWeights(const UnscentedParameters& parameters) {
    const double sum = parameters.alpha * parameters.alpha * (kDimension + parameters.kappa);  // N + lambda
    spread = std::sqrt(sum);
    mean_centre = 1.0 - kDimension / sum;
    covariance_centre = mean_centre + 1.0 - parameters.alpha * parameters.alpha + parameters.beta;
    other = 0.5 / sum;
  }

  double spread;             ///< sqrt(N + lambda): points lie this many standard deviations out
  double mean_centre;        ///< weight of the centre in the mean
  double covariance_centre;  ///< weight of the centre in the covariance
  double other;              ///< weight of each other point in both
};

/// Transformed sigma points as residuals from the transformed centre, whose own residual is zero.
///
/// Columns 2i and 2i + 1 come from the points above and below along column i of the root. Residuals are
/// formed, and angles wrapped, by the caller; from there on everything is linear, so no angle is ever
/// averaged.
template <int kOut, int kDimension>
using SigmaResiduals = Eigen::Matrix<double, kOut, 2 * kDimension>;

/// @return the mean's residual from the transformed centre
template <int kOut, int kDimension>
Eigen::Matrix<double, kOut, 1> sigma_mean(const SigmaResiduals<kOut, kDimension>& residuals,
                                          const SigmaWeights<kDimension>& weights) {
  return weights.other * residuals.rowwise().sum();
}

/// @return the covariance of the residuals about their mean
template <int kOut, int kDimension>
Eigen::Matrix<double, kOut, kOut> sigma_covariance(const SigmaResiduals<kOut, kDimension>& residuals,
                                                   const Eigen::Matrix<double, kOut, 1>& mean,
                                                   const SigmaWeights<kDimension>& weights) {
  const SigmaResiduals<kOut, kDimension> centred = residuals.colwise() - mean;
  return weights.other * (centred * centred.transpose()) +
         weights.covariance_centre * (mean * mean.transpose());
}

/// The covariance of the input's part along columns first..first+kIn-1 of its root with the output.
///
/// Opposite points have opposite inputs, so neither mean nor centre matter.
///
/// @param root block of the input's square root, kIn x kIn, for the columns above
template <int kIn, int kOut, int kDimension>
Eigen::Matrix<double, kIn, kOut> sigma_cross(const Eigen::Matrix<double, kIn, kIn>& root, int first,
                                             const SigmaResiduals<kOut, kDimension>& residuals,
                                             const SigmaWeights<kDimension>& weights) {
  Eigen::Matrix<double, kIn, kOut> cross = Eigen::Matrix<double, kIn, kOut>::Zero();
  for (int i = 0; i < kIn; ++i) {
    const int column = 2 * (first + i);
    cross += root.col(i) * (residuals.col(column) - residuals.col(column + 1)).transpose();
  }
  return weights.other * weights.spread * cross;
}

}  // namespace stereobench::slam
