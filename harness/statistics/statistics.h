/// Summaries over seeds and how far a mean can be trusted.
#pragma once

#include <limits>
#include <span>

namespace stereobench::harness {

/// A metric over several seeds. NaN where there is no value.
struct Summary {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN();  ///< with n - 1; 0 for a single value
  double max = std::numeric_limits<double>::quiet_NaN();
  /// Of the 95 % interval of the mean (Student t); +inf for a single value.
  double half_width = std::numeric_limits<double>::quiet_NaN();
  long count = 0;  ///< values that were finite; the others are left out
};

/// Mean, spread, largest value and 95 % interval of the finite ones among some values.
/// @param values one per seed; NaN stands for a run that could not be scored
/// @return count == 0 and NaN throughout when there is none
Summary summarise(std::span<const double> values);

/// The probability that |t| of Student's distribution is below a bound (Abramowitz and Stegun 26.7.3-4).
/// @param t >= 0
/// @param degrees_of_freedom >= 1
double student_t_two_sided(double t, long degrees_of_freedom);

/// The bound that |t| stays below with a probability.
/// @param probability in (0, 1)
/// @param degrees_of_freedom >= 1
double student_t_bound(double probability, long degrees_of_freedom);

/// The same for 95 %.
double student_t_95(long degrees_of_freedom);

}  // namespace stereobench::harness
