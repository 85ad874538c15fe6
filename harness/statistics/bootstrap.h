/// How far a change can be trusted, without a law of its distribution: jackknife and bootstrap.
#pragma once

#include <functional>
#include <span>

namespace stereobench::harness {

/// From where to where a value lies with a probability.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A change as a function of the means before and after it.
using Change = std::function<double(double first_mean, double second_mean)>;

/// The standard error of a change between the means of pairs, by leaving out one pair after the other
/// (jackknife).
/// @param first one value a pair, finite
/// @param second of the same pairs
/// @return infinite below two pairs
double standard_error(std::span<const double> first, std::span<const double> second, const Change& change);

/// The confidence interval of a change between the means of pairs.
///
/// Bias-corrected and accelerated bootstrap of the pairs (BCa; Efron, JASA 1987), widened for small samples
/// as Student's t is wider than a normal (Hesterberg, The American Statistician 2015). Below 10 pairs, too
/// few to resample, it is Student's t interval with the jackknife's standard error.
/// @param level in [0.5, 0.9999]: of 10,000 resamples the outermost say nothing beyond
/// @return infinite below two pairs. Equal arguments give equal bytes
Interval change_interval(std::span<const double> first, std::span<const double> second, double level,
                         const Change& change);

}  // namespace stereobench::harness
