#include "harness/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "harness/statistics/statistics.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kFewestToResample = 10;
constexpr std::size_t kResamples = 10000;

/// Pairs and what is looked at.
struct Sample {
  std::span<const double> first;
  std::span<const double> second;
  const Change& change;

  std::size_t size() const { return first.size(); }
};

double sum_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

double change_of(const Sample& sample) {
  const auto count = static_cast<double>(sample.size());
  return sample.change(sum_of(sample.first) / count, sum_of(sample.second) / count);
}

/// The change without one pair, by how much it is off from the mean of all such changes.
std::vector<double> left_out(const Sample& sample) {
  const double first = sum_of(sample.first);
  const double second = sum_of(sample.second);
  const auto rest = static_cast<double>(sample.size() - 1);
  std::vector<double> changes;
  for (std::size_t i = 0; i < sample.size(); ++i)
    changes.push_back(sample.change((first - sample.first[i]) / rest, (second - sample.second[i]) / rest));
  const double mean = sum_of(changes) / static_cast<double>(changes.size());
  for (double& change : changes) change = mean - change;
  return changes;
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// A sixth of the skewness.
double acceleration_of(const std::vector<double>& left_out) {
  double cubes = 0.0;
  for (const double off : left_out) cubes += off * off * off;
  const double squares = sum_of_squares(left_out);
  return squares > 0.0 ? cubes / (6.0 * squares * std::sqrt(squares)) : 0.0;
}

/// The changes of samples that are drawn from the pairs with replacement, sorted.
std::vector<double> resampled_changes(const Sample& sample) {
  slam::RandomStream random(0, slam::Stream::kResample, sample.size());
  const auto count = static_cast<std::uint64_t>(sample.size());
  std::vector<double> changes;
  changes.reserve(kResamples);
  for (std::size_t i = 0; i < kResamples; ++i) {
    double first = 0.0;
    double second = 0.0;
    for (std::size_t k = 0; k < sample.size(); ++k) {
      const auto drawn = static_cast<std::size_t>((count * std::uint64_t{random.bits()}) >> 32U);
      first += sample.first[drawn];
      second += sample.second[drawn];
    }
    changes.push_back(sample.change(first / static_cast<double>(count), second / static_cast<double>(count)));
  }
  std::ranges::sort(changes);
  return changes;
}

double normal_below(double x) {
  return 0.5 * slam::complementary_error(-x / std::numbers::sqrt2);
}

/// How many standard deviations of the resampled changes lie below the change itself.
double bias_of(const std::vector<double>& changes, double change) {
  const auto [first, last] = std::equal_range(changes.begin(), changes.end(), change);
  const auto below = static_cast<double>(first - changes.begin()) + 0.5 * static_cast<double>(last - first);
  const auto count = static_cast<double>(changes.size());
  return slam::normal_quantile(std::clamp(below, 0.5, count - 0.5) / count);
}

double at(const std::vector<double>& sorted, double probability) {
  const double place = probability * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace

double standard_error(std::span<const double> first, std::span<const double> second, const Change& change) {
  if (first.size() < 2) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<double>(first.size());
  return std::sqrt((count - 1.0) / count * sum_of_squares(left_out({first, second, change})));
}

Interval change_interval(std::span<const double> first, std::span<const double> second, double level,
                         const Change& change) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (first.size() < 2) return {-kInfinity, kInfinity};
  const Sample sample{first, second, change};
  const auto count = static_cast<double>(sample.size());
  const double centre = change_of(sample);
  const double t = student_t_bound(level, static_cast<long>(sample.size()) - 1);
  if (sample.size() < kFewestToResample) {
    const double half_width = t * standard_error(first, second, change);
    return {centre - half_width, centre + half_width};
  }
  const std::vector<double> changes = resampled_changes(sample);
  const double bias = bias_of(changes, centre);
  const double acceleration = acceleration_of(left_out(sample));
  const double widened = t * std::sqrt(count / (count - 1.0));
  const auto end = [&](double z) {
    const double off = bias + z;
    return at(changes, normal_below(bias + off / std::max(1e-3, 1.0 - acceleration * off)));
  };
  return {end(-widened), end(widened)};
}

}  // namespace stereobench::harness
