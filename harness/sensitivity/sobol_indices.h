/// Which share of a metric's variance comes from which factor: Sobol' indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "harness/statistics/bootstrap.h"

namespace stereobench::harness {

/// A share of the variance with its interval; NaN where there is none.
struct IndexEstimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  Interval interval = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
};

struct FactorIndices {
  /// Of the variance, the share that is gone on average where this factor is known. An estimate below 0 is a
  /// sampling error.
  IndexEstimate first;
  /// Of the variance, the share that is left on average where all other factors are known; never below 0.
  IndexEstimate total;
  /// Total less first: the share in which this factor acts together with others.
  IndexEstimate interactions;
};

struct SobolIndices {
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< of the metric, over the rows of A and B
  double sd = std::numeric_limits<double>::quiet_NaN();
  std::size_t rows = 0;           ///< that the indices are made of
  std::size_t rows_left_out = 0;  ///< in which a run gave no value
  std::size_t failed_runs = 0;    ///< that gave no value
  std::vector<FactorIndices> factors;
};

/// How intervals are made.
struct Resampling {
  double level = 0.95;  ///< in [0.5, 0.99]: of 2,000 resamples the outermost say nothing beyond
  std::uint64_t seed = 0;
};

/// The indices of results at the points of pick_freeze_points().
///
/// First: the coefficient of B's results where those of the copy are explained by those of A and B, both
/// standardised: (r_Bi - r_Ai r_AB) / (1 - r_AB^2), of the correlations r between the results of A, B and the
/// i-th copy. The term r_AB, which is 0 but for chance, takes chance out (Glen and Isaacs, Environmental
/// Modelling & Software 2012). With 256 rows of a sum of two keys and chance, whose indices are 0.18, 0.02
/// and 0.8, its rms errors are 0.032, 0.011 and 0.019; Saltelli's estimator (2010) has 0.035, 0.012 and
/// 0.080, that of Janon et al. (2014) 0.058, 0.063 and 0.015. Total: Jansen's estimator, mean (f_A - f_i)^2 /
/// 2 over the variance (1999). Intervals: percentiles of a bootstrap of rows.
/// @param results one a point; what is not finite is a run that failed, and its row is left out of everything
/// @param factors how many there are
/// @return NaN where fewer than 10 rows are left, or the metric does not vary. Equal arguments give equal
/// bytes
/// @throws std::invalid_argument when the results are no multiple of factors + 2, or the level is out of
/// range
SobolIndices sobol_indices(std::span<const double> results, std::size_t factors,
                           const Resampling& resampling);

}  // namespace stereobench::harness
