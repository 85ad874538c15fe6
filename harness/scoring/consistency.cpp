#include "harness/scoring/consistency.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "slam/motion.h"

namespace stereobench::harness {

namespace {

constexpr std::size_t kFirstStep = 2;
constexpr double kSmallestEigenvalue = 1e-9;  // of a correlation matrix, whose eigenvalues sum to at most 3

}  // namespace

std::optional<double> normalised_error(const slam::Pose& estimate, const Eigen::Matrix3d& covariance,
                                       const slam::Pose& truth) {
  if (!covariance.allFinite()) return {};
  const Eigen::Vector3d error(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m,
                              slam::wrap_angle(estimate.heading_rad - truth.heading_rad));
  // Metres and radians do not compare, so the rank is that of the correlations, which have no unit.
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (covariance(i, i) > 0.0) scale[i] = 1.0 / std::sqrt(covariance(i, i));
  }
  const Eigen::Matrix3d correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(correlation);
  const Eigen::Vector3d along = solver.eigenvectors().transpose() * error.cwiseProduct(scale);
  double sum = 0.0;
  int rank = 0;
  for (int i = 0; i < 3; ++i) {
    if (solver.eigenvalues()[i] < kSmallestEigenvalue) continue;
    sum += along[i] * along[i] / solver.eigenvalues()[i];
    ++rank;
  }
  if (rank == 0 || !std::isfinite(sum)) return {};
  return sum / rank;
}

std::vector<std::optional<double>> normalised_errors(const FilterRun& run, const MeasurementLog& log) {
  std::vector<std::optional<double>> errors(log.steps.size());
  const std::size_t recorded = std::min({run.poses.size(), run.covariances.size(), log.steps.size()});
  for (std::size_t i = kFirstStep; i < recorded; ++i) {
    if (!log.steps[i].truth) continue;
    errors[i] = normalised_error(run.poses[i], run.covariances[i], *log.steps[i].truth);
  }
  return errors;
}

std::vector<std::optional<double>> average_over_seeds(
    std::span<const std::vector<std::optional<double>>> runs) {
  std::size_t longest = 0;
  for (const auto& run : runs) longest = std::max(longest, run.size());
  std::vector<std::optional<double>> averages(longest);
  for (std::size_t step = 0; step < longest; ++step) {
    double sum = 0.0;
    long count = 0;
    for (const auto& run : runs) {
      if (step >= run.size() || !run[step]) continue;
      sum += *run[step];
      ++count;
    }
    if (count > 0) averages[step] = sum / static_cast<double>(count);
  }
  return averages;
}

}  // namespace stereobench::harness
