/// Chi-square: the distribution of squared lengths that are measured in their own standard deviations.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stereobench::harness {

/// A sum of squared lengths, and how many squared standard normals it would be a sum of if all were
/// consistent.
struct SquaredSum {
  double sum = 0.0;
  long degrees_of_freedom = 0;

  /// @return 1 on average when consistent; NaN for nothing
  double ratio() const { return sum / static_cast<double>(degrees_of_freedom); }
  SquaredSum& operator+=(const SquaredSum& other) {
    sum += other.sum;
    degrees_of_freedom += other.degrees_of_freedom;
    return *this;
  }
};

/// What the seeds of a run differ in.
enum class Seeds {
  kWorlds,   ///< each has its own noise, and errors do not depend on each other
  kFilters,  ///< one recorded log, filtered with other random numbers: errors hang together
};

/// A sum over seeds as it may be held against chi-square. Where seeds hang together they are worth one: their
/// mean is judged, which is exact for seeds that are the same, and cautious for others.
/// @param count of the seeds
SquaredSum worth(const SquaredSum& sum, Seeds seeds, std::size_t count);

/// Between which bounds a ratio lies when all is consistent.
struct Band {
  double low = 0.0;
  double high = 0.0;
};

/// The value that chi-square stays below with a probability.
/// @param probability in (0, 1)
/// @param degrees_of_freedom >= 1
double chi_square_quantile(double probability, long degrees_of_freedom);

/// The band that sum / degrees of freedom lies in with a probability, the same left out at both ends.
/// @return NaN for no degrees of freedom
Band chi_square_band(double probability, long degrees_of_freedom);

/// How probable a smaller sum is when all is consistent.
/// @param sum of at least one degree of freedom
double chi_square_below(const SquaredSum& sum);

/// How probable a sum that is at least as far out is, on whichever side it lies, when all is consistent.
/// @return in [0, 1]; 1 for no degrees of freedom; 0 for a sum that is not finite
double chi_square_p(const SquaredSum& sum);

/// What is left of each of many p-values when that many were looked at: the chance of any that small, if
/// nothing were wrong with any (Holm 1979). Those below a level are significant, all together, at that level.
/// @return in their order; in [0, 1], and not below those given
std::vector<double> holm(std::span<const double> p_values);

}  // namespace stereobench::harness
