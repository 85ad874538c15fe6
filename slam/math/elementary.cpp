#include "slam/math/elementary.h"

#include <sleef.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace stereobench::slam {

SineCosine sine_cosine(double angle_rad) {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u35purec(angle_rad);
  return {both.x, both.y};
}

double tangent(double angle_rad) {
  return Sleef_cinz_tand1_u35purec(angle_rad);
}

double arc_tangent(double y, double x) {
  return Sleef_cinz_atan2d1_u35purec(y, x);
}

std::array<double, 2> arc_tangents(const std::array<double, 2>& y, const std::array<double, 2>& x) {
#ifdef __SSE2__
  std::array<double, 2> both{};
  _mm_storeu_pd(both.data(), Sleef_cinz_atan2d2_u35sse2(_mm_loadu_pd(y.data()), _mm_loadu_pd(x.data())));
  return both;
#else
  return {arc_tangent(y[0], x[0]), arc_tangent(y[1], x[1])};
#endif
}

double exponential(double x) {
  return Sleef_cinz_expd1_u10purec(x);
}

double logarithm(double x) {
  return Sleef_cinz_logd1_u35purec(x);
}

double logarithm_of_one_plus(double x) {
  return Sleef_cinz_log1pd1_u10purec(x);
}

double power(double base, double exponent) {
  return Sleef_cinz_powd1_u10purec(base, exponent);
}

double complementary_error(double x) {
  return Sleef_cinz_erfcd1_u15purec(x);
}

}  // namespace stereobench::slam
