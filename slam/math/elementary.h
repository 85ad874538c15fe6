/// Sines, logarithms and their kin with the same bits on every processor.
///
/// The C library chooses its kernels by what the processor can do, and where it has fused multiply-add the
/// last bit of one sine in a thousand is another. A particle filter makes another path of that. These
/// functions round alike everywhere: SLEEF's `cinz` kernels, without fused operations on any processor
/// (Shibata and Petrogalli, IEEE TPDS 2020). sqrt and remainder are exact by IEEE 754 and may come from
/// anywhere.
#pragma once

#include <array>

namespace stereobench::slam {

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// @param angle_rad any; the result of one that is not finite is NaN
/// @return both, within 3.5 units in the last place
SineCosine sine_cosine(double angle_rad);

/// @return the tangent, within 3.5 units in the last place
double tangent(double angle_rad);

/// @return the direction of (x, y) in [-pi, pi], within 3.5 units in the last place; 0 for (0, 0)
double arc_tangent(double y, double x);

/// @return the arc tangents of two directions at once, to the last bit those of arc_tangent
std::array<double, 2> arc_tangents(const std::array<double, 2>& y, const std::array<double, 2>& x);

/// @return e^x, within 1 unit in the last place
double exponential(double x);

/// @return the natural logarithm, within 3.5 units in the last place; -infinity for 0, NaN below
double logarithm(double x);

/// @return log(1 + x), within 1 unit in the last place; -infinity for -1, NaN below
double logarithm_of_one_plus(double x);

/// @return base^exponent for base >= 0, within 1 unit in the last place
double power(double base, double exponent);

/// @return erfc(x) = 1 - erf(x), within 1.5 units in the last place
double complementary_error(double x);

}  // namespace stereobench::slam
