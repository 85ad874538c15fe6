/// The law of a response: what the sensor costs and what all else costs add up as independent errors do.
#pragma once

#include <limits>
#include <span>

namespace stereobench::harness {

/// error^2 = floor^2 + slope^2 / (1 / level^2 + 1 / upper_knee^2).
///
/// Twice the noise of a measurement is twice the error of what is estimated from it, so that errors grow in
/// proportion to the level: by the slope. Far above the upper knee they do not, as information adds up: there
/// odometry knows more than the sensor says.
struct FloorAndSlope {
  double floor = 0.0;  ///< the error at level 0
  double slope = 0.0;  ///< error per unit of the level, where the sensor is all
  double upper_knee = std::numeric_limits<double>::infinity();  ///< a level; infinite: a floor and a line

  double at(double level) const;
  /// The level at which the sensor costs as much as all else; +infinity where it never does.
  double knee() const;
};

/// Fits mean squares of errors by weighted least squares of their deviations, each relative to the law there.
///
/// This is the quasi-likelihood of errors in proportion to what is measured (Wedderburn, Biometrika 1974). It
/// is not biased by the spread of mean squares, as logarithms are, and weighs the levels alike.
/// @param levels >= 0, at least one
/// @param mean_squares >= 0, one a level
/// @param weights >= 0, one a level, e.g. how many runs it has; levels of weight 0 are left out
/// @return a floor and a line: a floor of 0 where the first levels are below a line through 0, a slope of 0
/// where errors do not grow; NaN where all weights are 0
FloorAndSlope fit_floor_and_slope(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights);

/// The same with an upper knee: that of least deviance among levels that are 19 % apart.
/// @return an upper knee from half the lowest level above 0 to four times the highest; infinite where the
/// line deviates as little
FloorAndSlope fit_with_upper_knee(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights);

}  // namespace stereobench::harness
