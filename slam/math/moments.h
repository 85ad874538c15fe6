/// Mean and covariance of many weighted Gaussians taken as one.
#pragma once

#include <Eigen/Core>

#include "slam/math/gaussian.h"

namespace stereobench::slam {

/// Sums up weighted Gaussians as offsets from a reference, which keeps digits and wraps angles once.
template <int kSize>
struct Moments {
  Eigen::Matrix<double, kSize, 1> first = Eigen::Matrix<double, kSize, 1>::Zero();
  Eigen::Matrix<double, kSize, kSize> second = Eigen::Matrix<double, kSize, kSize>::Zero();
  double total = 0.0;

  /// What has no weight may be no number.
  void add(double weight, const Eigen::Matrix<double, kSize, 1>& offset,
           const Eigen::Matrix<double, kSize, kSize>& covariance) {
    if (weight == 0.0) return;
    total += weight;
    first += weight * offset;
    second += weight * (covariance + offset * offset.transpose());
  }
  Eigen::Matrix<double, kSize, 1> mean() const { return first / total; }
  Eigen::Matrix<double, kSize, kSize> covariance() const {
    Eigen::Matrix<double, kSize, kSize> difference = second / total - mean() * mean().transpose();
    long of_the_report = 0;  // where the reference lies far from the weight; no belief is repaired
    project_to_psd<kSize>(difference, of_the_report);
    return difference;
  }
};

}  // namespace stereobench::slam
