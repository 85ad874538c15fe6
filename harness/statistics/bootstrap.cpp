#include "harness/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "harness/statistics/statistics.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kFewestToResample = 10;
constexpr std::size_t kResamples = 10000;

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The means of samples that are drawn from the values with replacement, sorted.
std::vector<double> resampled_means(std::span<const double> values) {
  slam::RandomStream random(0, slam::Stream::kResample, values.size());
  const auto count = static_cast<std::uint64_t>(values.size());
  std::vector<double> means;
  means.reserve(kResamples);
  for (std::size_t i = 0; i < kResamples; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      sum += values[static_cast<std::size_t>((count * std::uint64_t{random.bits()}) >> 32U)];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::ranges::sort(means);
  return means;
}

double normal_below(double x) {
  return 0.5 * slam::complementary_error(-x / std::numbers::sqrt2);
}

/// How many standard deviations of the resampled means lie below the mean itself.
double bias_of(const std::vector<double>& means, double mean) {
  const auto [first, last] = std::ranges::equal_range(means, mean);
  const auto below = static_cast<double>(first - means.begin()) + 0.5 * static_cast<double>(last - first);
  const auto count = static_cast<double>(means.size());
  return slam::normal_quantile(std::clamp(below, 0.5, count - 0.5) / count);
}

/// A sixth of the skewness of the mean: for a mean, leaving one value out after the other gives this.
double acceleration_of(std::span<const double> values, double mean) {
  double squares = 0.0;
  double cubes = 0.0;
  for (const double value : values) {
    const double off = value - mean;
    squares += off * off;
    cubes += off * off * off;
  }
  return cubes / (6.0 * squares * std::sqrt(squares));
}

double at(const std::vector<double>& sorted, double probability) {
  const double place = probability * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace

double student_t_quantile(double probability, long degrees_of_freedom) {
  const boost::math::students_t student(static_cast<double>(degrees_of_freedom));
  return boost::math::quantile(boost::math::complement(student, 0.5 * (1.0 - probability)));
}

Interval mean_interval(std::span<const double> values, double level) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (values.size() < 2) return {-kInfinity, kInfinity};
  if (std::ranges::count(values, values.front()) == std::ssize(values))
    return {values.front(), values.front()};
  const Summary summary = summarise(values);
  const auto count = static_cast<double>(values.size());
  const double t = student_t_quantile(level, static_cast<long>(values.size()) - 1);
  if (values.size() < kFewestToResample) {
    const double half_width = t * summary.sd / std::sqrt(count);
    return {summary.mean - half_width, summary.mean + half_width};
  }
  const std::vector<double> means = resampled_means(values);
  const double centre = mean(values);
  const double bias = bias_of(means, centre);
  const double acceleration = acceleration_of(values, centre);
  const double widened = t * std::sqrt(count / (count - 1.0));
  const auto end = [&](double z) {
    const double off = bias + z;
    return at(means, normal_below(bias + off / std::max(1e-3, 1.0 - acceleration * off)));
  };
  return {end(-widened), end(widened)};
}

}  // namespace stereobench::harness
