/// Whether a filter's covariance is the one its errors really have.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/types.h"

namespace stereobench::harness {

/// Normalised estimation error squared, e' P^+ e / rank(P), with heading wrapped; 1 on average when
/// the covariance is honest. P may be singular: directions without variance are left out, and so is their
/// error.
/// @return nothing when P is zero or not finite
std::optional<double> normalised_error(const slam::Pose& estimate, const Eigen::Matrix3d& covariance,
                                       const slam::Pose& truth);

/// The normalised error of each step of a run.
/// @return as many as the log has steps; none at the first step, where the start is given, nor at the second:
///   after one control from an exact start two noises spread over three states, and what the second order of
///   their product adds across has no variance to be measured by; and none where there is no truth or no
///   covariance
std::vector<std::optional<double>> normalised_errors(const FilterRun& run, const MeasurementLog& log);

/// The average over seeds of the normalised error, step by step (ANEES).
/// @param runs one per seed; they may have different lengths
/// @return as long as the longest; none where no seed has a value
std::vector<std::optional<double>> average_over_seeds(
    std::span<const std::vector<std::optional<double>>> runs);

}  // namespace stereobench::harness
