#include "slam/elementary.h"

#include <sleef.h>

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
