/// How far a mean can be trusted, without a law of its distribution: the bootstrap.
#pragma once

#include <cstdint>
#include <span>

namespace stereobench::harness {

/// From where to where a value lies with a probability.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// The confidence interval of the mean of some values.
///
/// Bias-corrected and accelerated bootstrap (BCa; Efron, JASA 1987), widened for small samples as Student's t
/// is wider than a normal (Hesterberg, The American Statistician 2015). Below 10 values, too few to resample,
/// it is Student's t interval.
/// @param values finite
/// @param level in (0, 1), e.g. 0.99
/// @return the value itself where all are equal; infinite below two values. Equal arguments give equal bytes
Interval mean_interval(std::span<const double> values, double level);

/// The bound that |t| of Student's distribution stays below with a probability.
/// @param probability in (0, 1)
/// @param degrees_of_freedom >= 1
double student_t_quantile(double probability, long degrees_of_freedom);

}  // namespace stereobench::harness
