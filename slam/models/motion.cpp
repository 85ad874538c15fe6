#include "slam/models/motion.h"

#include <cmath>

namespace stereobench::slam {
namespace {

/// sin(x) / x, which is 1 - x^2/6 to the last bit where the quotient would lose it.
double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : sine_cosine(x).sine / x;
}

}  // namespace

Pose advance(const Pose& pose, const Control& control) {
  const double half_turn_rad = 0.5 * control.w_radps * control.duration_s;
  const double bent = sinc(half_turn_rad);
  const double along_m = control.v_mps * control.duration_s * bent;
  const double across_m = control.lateral_mps * control.duration_s * bent;
  const double direction_rad = pose.heading_rad + half_turn_rad;
  const auto [s, c] = sine_cosine(direction_rad);
  return {pose.x_m + along_m * c - across_m * s, pose.y_m + along_m * s + across_m * c,
          wrap_angle(pose.heading_rad + 2.0 * half_turn_rad)};
}

Pose compose(const Pose& a_from_b, const Pose& b_from_c) {
  return compose(a_from_b, sine_cosine(a_from_b.heading_rad), b_from_c);
}

Pose compose(const Pose& a_from_b, SineCosine heading, const Pose& b_from_c) {
  const auto [s, c] = heading;
  return {a_from_b.x_m + c * b_from_c.x_m - s * b_from_c.y_m,
          a_from_b.y_m + s * b_from_c.x_m + c * b_from_c.y_m,
          wrap_angle(a_from_b.heading_rad + b_from_c.heading_rad)};
}

Pose inverse(const Pose& a_from_b) {
  const auto [s, c] = sine_cosine(a_from_b.heading_rad);
  return {-c * a_from_b.x_m - s * a_from_b.y_m, s * a_from_b.x_m - c * a_from_b.y_m,
          wrap_angle(-a_from_b.heading_rad)};
}

Eigen::Vector2d standard_deviations(const Control& control, const OdometryNoise& noise) {
  const double v = std::abs(control.v_mps);
  const double w = std::abs(control.w_radps);
  const bool brief = control.duration_s > 0.0 && control.duration_s < noise.correlation_s;
  const double share = brief ? std::sqrt(noise.correlation_s / control.duration_s) : 1.0;
  return share * Eigen::Vector2d(noise.v_constant_mps + noise.v_per_v * v + noise.v_per_w * w,
                                 noise.w_constant_radps + noise.w_per_v * v + noise.w_per_w * w);
}

Control perturb(const Control& control, const OdometryNoise& noise, RandomStream& random) {
  const Eigen::Vector2d sd = standard_deviations(control, noise);
  Control perturbed = control;
  perturbed.v_mps += sd.x() * random.normal();
  perturbed.w_radps += sd.y() * random.normal();
  return perturbed;
}

bool is_valid(const Control& control) {
  return std::isfinite(control.v_mps) && std::isfinite(control.w_radps) &&
         std::isfinite(control.lateral_mps) && std::isfinite(control.duration_s) &&
         control.duration_s >= 0.0 && (!control.covariance || control.covariance->allFinite());
}

}  // namespace stereobench::slam
