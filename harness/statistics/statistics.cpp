#include "harness/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 1 + x (k / (k + 1)) + x^2 (k / (k + 1)) ((k + 2) / (k + 3)) ..., the sum that both parities share.
double cosine_series(double cosine_squared, long terms, double first_factor) {
  double term = 1.0;
  double sum = terms > 0 ? 1.0 : 0.0;
  double factor = first_factor;
  for (long i = 1; i < terms; ++i, factor += 2.0) {
    term *= cosine_squared * factor / (factor + 1.0);
    sum += term;
  }
  return sum;
}

}  // namespace

Summary summarise(std::span<const double> values) {
  Summary summary{kNone, kNone, kNone, kNone, 0};
  double sum = 0.0;
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++summary.count;
    sum += value;
    largest = std::max(largest, value);
  }
  if (summary.count == 0) return summary;
  const double count = static_cast<double>(summary.count);
  summary.mean = sum / count;
  summary.max = largest;
  double squares = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) squares += (value - summary.mean) * (value - summary.mean);
  }
  summary.sd = summary.count > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  summary.half_width = summary.count > 1 ? student_t_95(summary.count - 1) * summary.sd / std::sqrt(count)
                                         : std::numeric_limits<double>::infinity();
  return summary;
}

double student_t_two_sided(double t, long degrees_of_freedom) {
  if (!(t >= 0.0) || degrees_of_freedom < 1) throw std::invalid_argument("student_t: t >= 0, degrees >= 1");
  const double angle = slam::arc_tangent(t, std::sqrt(static_cast<double>(degrees_of_freedom)));
  const auto [sine, cosine] = slam::sine_cosine(angle);
  if (degrees_of_freedom % 2 == 0) {
    return sine * cosine_series(cosine * cosine, degrees_of_freedom / 2, 1.0);
  }
  const double series = cosine_series(cosine * cosine, (degrees_of_freedom - 1) / 2, 2.0);
  return (angle + sine * cosine * series) * 2.0 / slam::kPi;
}

double student_t_bound(double probability, long degrees_of_freedom) {
  double low = 0.0;
  double high = 16.0;
  while (student_t_two_sided(high, degrees_of_freedom) < probability) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_two_sided(middle, degrees_of_freedom) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double student_t_95(long degrees_of_freedom) {
  return student_t_bound(0.95, degrees_of_freedom);
}

}  // namespace stereobench::harness
