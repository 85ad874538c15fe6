/// Summaries over seeds and how far a mean can be trusted.
#pragma once

#include <span>

namespace stereobench::harness {

/// A metric over several seeds.
struct Summary {
  double mean = 0.0;  ///< NaN when there is no value
  double sd = 0.0;    ///< with n - 1; 0 for a single value
  double max = 0.0;
  double half_width = 0.0;  ///< of the 95 % interval of the mean (Student t); +inf for a single value
  long count = 0;           ///< values that were finite; the others are left out
};

/// Mean, spread, largest value and 95 % interval of the finite ones among some values.
/// @param values one per seed; NaN stands for a run that could not be scored
/// @return count == 0 and NaN throughout when there is none
Summary summarise(std::span<const double> values);

/// The probability that |t| of Student's distribution is below a bound (Abramowitz and Stegun 26.7.3-4).
/// @param t >= 0
/// @param degrees_of_freedom >= 1
double student_t_two_sided(double t, long degrees_of_freedom);

/// The bound that |t| stays below with 95 % probability.
/// @param degrees_of_freedom >= 1
double student_t_95(long degrees_of_freedom);

}  // namespace stereobench::harness
