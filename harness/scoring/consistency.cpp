#include "harness/scoring/consistency.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "slam/models/motion.h"

namespace stereobench::harness {

namespace {

constexpr double kSmallestEigenvalue = 1e-9;  // of a correlation matrix, whose eigenvalues sum to at most 3
constexpr double kSignificantAdjusted = 0.05;

template <int kSize>
std::optional<SquaredSum> normalised(const Eigen::Matrix<double, kSize, 1>& error,
                                     const Eigen::Matrix<double, kSize, kSize>& covariance) {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  if (!covariance.allFinite()) return {};
  // Metres and radians do not compare, so the rank is that of the correlations, which have no unit.
  Vector scale = Vector::Zero();
  for (int i = 0; i < kSize; ++i) {
    if (covariance(i, i) > 0.0) scale[i] = 1.0 / std::sqrt(covariance(i, i));
  }
  const Matrix correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(correlation);
  const Vector along = solver.eigenvectors().transpose() * error.cwiseProduct(scale);
  SquaredSum squared;
  for (int i = 0; i < kSize; ++i) {
    if (solver.eigenvalues()[i] < kSmallestEigenvalue) continue;
    squared += {along[i] * along[i] / solver.eigenvalues()[i], 1};
  }
  if (squared.degrees_of_freedom == 0 || !std::isfinite(squared.sum)) return {};
  return squared;
}

}  // namespace

std::optional<SquaredSum> normalised_error(const slam::Pose& estimate, const Eigen::Matrix3d& covariance,
                                           const slam::Pose& truth) {
  const Eigen::Vector3d error(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m,
                              slam::wrap_angle(estimate.heading_rad - truth.heading_rad));
  return normalised<3>(error, covariance);
}

std::optional<SquaredSum> normalised_error(const Eigen::Vector2d& error_m,
                                           const Eigen::Matrix2d& covariance) {
  return normalised<2>(error_m, covariance);
}

std::vector<std::optional<SquaredSum>> normalised_errors(const FilterRun& run, const MeasurementLog& log) {
  std::vector<std::optional<SquaredSum>> errors(log.steps.size());
  const std::size_t recorded = std::min({run.poses.size(), run.covariances.size(), log.steps.size()});
  for (std::size_t i = kFirstScoredStep; i < recorded; ++i) {
    if (!log.steps[i].truth) continue;
    errors[i] = normalised_error(run.poses[i], run.covariances[i], *log.steps[i].truth);
  }
  return errors;
}

void add_steps(std::vector<SquaredSum>& sums, std::span<const std::optional<SquaredSum>> run) {
  sums.resize(std::max(sums.size(), run.size()));
  for (std::size_t step = 0; step < run.size(); ++step)
    if (run[step]) sums[step] += *run[step];
}

StepVerdict judge_steps(std::span<const SquaredSum> steps) {
  std::vector<std::size_t> scored;
  std::vector<double> p_values;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    if (steps[step].degrees_of_freedom == 0) continue;
    scored.push_back(step);
    p_values.push_back(chi_square_p(steps[step]));
  }
  StepVerdict verdict{.steps = static_cast<long>(scored.size())};
  long outside = 0;
  const std::vector<double> adjusted = holm(p_values);
  for (std::size_t i = 0; i < scored.size(); ++i) {
    if (!(adjusted[i] < kSignificantAdjusted)) continue;
    ++outside;
    if (!verdict.first_outside) verdict.first_outside = scored[i];
  }
  verdict.fraction_outside = static_cast<double>(outside) / static_cast<double>(verdict.steps);  // 0 / 0
  return verdict;
}

}  // namespace stereobench::harness
