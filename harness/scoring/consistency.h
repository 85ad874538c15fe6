/// Whether a filter's covariance is the one its errors really have (NEES).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/statistics/chi_square.h"
#include "harness/types.h"

namespace stereobench::harness {

/// The first step of a run whose error is scored against its covariance. At the first the start is given;
/// after one control from an exact start two noises spread over three states, and what the second order of
/// their product adds across has no variance to be measured by.
inline constexpr std::size_t kFirstScoredStep = 2;

/// Normalised estimation error squared, e' P^+ e with the rank of P, with heading wrapped; its ratio is 1 on
/// average when the covariance is consistent. P may be singular: directions without variance are left out,
/// and so is their error.
/// @return nothing when P is zero or not finite
std::optional<SquaredSum> normalised_error(const slam::Pose& estimate, const Eigen::Matrix3d& covariance,
                                           const slam::Pose& truth);

/// The same of a position in the plane.
std::optional<SquaredSum> normalised_error(const Eigen::Vector2d& error_m, const Eigen::Matrix2d& covariance);

/// The normalised error of each step of a run.
/// @return as many as the log has steps; none before kFirstScoredStep, and none where there is no truth or no
///   covariance
std::vector<std::optional<SquaredSum>> normalised_errors(const FilterRun& run, const MeasurementLog& log);

/// Adds the normalised errors of a seed's run to the sums over seeds, step by step. Steps of one run hang
/// together and are not summed.
/// @param sums one a step of the longest run; a step has no degrees of freedom until a seed has a value there
void add_steps(std::vector<SquaredSum>& sums, std::span<const std::optional<SquaredSum>> run);

/// Which steps are consistent.
struct StepVerdict {
  long steps = 0;                 ///< that have a value
  double fraction_outside = 0.0;  ///< of their 95 % band, Holm-corrected for the number of steps; NaN
  std::optional<std::size_t> first_outside;  ///< the first of them, counted from 0
};

StepVerdict judge_steps(std::span<const SquaredSum> steps);

}  // namespace stereobench::harness
