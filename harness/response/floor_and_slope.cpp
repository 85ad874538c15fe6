#include "harness/response/floor_and_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr double kLowest = 1e-9;
constexpr double kHighest = 1e4;

/// What is fitted.
struct MeanSquares {
  std::span<const double> levels;
  std::span<const double> values;
  std::span<const double> weights;
};

/// The weighted mean of a value of each level.
template <typename Value>
double weighted_mean(const MeanSquares& data, const Value& value_of) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < data.levels.size(); ++i) {
    if (!(data.weights[i] > 0.0)) continue;
    sum += data.weights[i] * value_of(i);
    weights += data.weights[i];
  }
  return sum / weights;
}

double shape(const MeanSquares& data, double knee, std::size_t i) {
  return knee * knee + data.levels[i] * data.levels[i];
}

/// The square of the best slope for a knee: the scale at which ratios to the law are 1 on average.
double slope_squared(const MeanSquares& data, double knee) {
  return weighted_mean(data, [&](std::size_t i) { return data.values[i] / shape(data, knee, i); });
}

/// Above 0 where a larger knee fits better: the derivative of the quasi-likelihood, at the best slope.
double score(const MeanSquares& data, double knee) {
  const double scale = slope_squared(data, knee);
  return weighted_mean(data, [&](std::size_t i) {
    const double law = shape(data, knee, i);
    return (data.values[i] / (scale * law) - 1.0) / law;
  });
}

/// The level of a line on which the error is that of the law.
double bent_level(double level, double upper_knee) {
  return level / std::sqrt(1.0 + level * level / (upper_knee * upper_knee));
}

/// The deviance of the quasi-likelihood.
double deviance(const MeanSquares& data, const FloorAndSlope& law) {
  return weighted_mean(data, [&](std::size_t i) {
    const double ratio = data.values[i] / (law.at(data.levels[i]) * law.at(data.levels[i]));
    return ratio - 1.0 - slam::logarithm(ratio);
  });
}

/// From where to where knees can be told from none: beyond, the law is a line or a constant to the last bit.
struct KneeRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
};

KneeRange knee_range(const MeanSquares& data) {
  KneeRange range;
  for (std::size_t i = 0; i < data.levels.size(); ++i) {
    if (!(data.weights[i] > 0.0) || !(data.levels[i] > 0.0)) continue;
    range.low = std::min(range.low, kLowest * data.levels[i]);
    range.high = std::max(range.high, kHighest * data.levels[i]);
  }
  return range;
}

}  // namespace

double FloorAndSlope::at(double level) const {
  const double bent = bent_level(level, upper_knee);
  return std::sqrt(floor * floor + slope * slope * bent * bent);
}

double FloorAndSlope::knee() const {
  const double bent = floor / slope;
  return bent < upper_knee ? bent / std::sqrt(1.0 - bent * bent / (upper_knee * upper_knee))
                           : std::numeric_limits<double>::infinity();
}

FloorAndSlope fit_floor_and_slope(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights) {
  constexpr int kHalvings = 34;
  constexpr double kRounding = 1e-12;
  const MeanSquares data = {levels, mean_squares, weights};
  const double constant = weighted_mean(data, [&](std::size_t i) { return mean_squares[i]; });
  const auto moment = [&](double origin) {
    return weighted_mean(data,
                         [&](std::size_t i) { return levels[i] * levels[i] * (mean_squares[i] - origin); });
  };
  if (!(moment(constant) > kRounding * moment(0.0))) return {.floor = std::sqrt(constant), .slope = 0.0};
  auto [low, high] = knee_range(data);
  if (score(data, low) <= 0.0) return {.floor = 0.0, .slope = std::sqrt(slope_squared(data, low))};
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (score(data, middle) > 0.0 ? low : high) = middle;
  }
  const double knee = std::sqrt(low * high);
  const double slope = std::sqrt(slope_squared(data, knee));
  return {.floor = knee * slope, .slope = slope};
}

FloorAndSlope fit_with_upper_knee(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights) {
  constexpr double kStep = 1.189207115002721;  // 2^(1/4)
  const MeanSquares data = {levels, mean_squares, weights};
  FloorAndSlope best = fit_floor_and_slope(levels, mean_squares, weights);
  double least = deviance(data, best);
  const auto [low, high] = knee_range(data);
  for (double upper_knee = 0.5 * low / kLowest; upper_knee <= 4.0 * high / kHighest; upper_knee *= kStep) {
    std::vector<double> bent;
    for (const double level : levels) bent.push_back(bent_level(level, upper_knee));
    FloorAndSlope law = fit_floor_and_slope(bent, mean_squares, weights);
    law.upper_knee = upper_knee;
    const double deviation = deviance(data, law);
    if (!(deviation < least)) continue;
    least = deviation;
    best = law;
  }
  return best;
}

}  // namespace stereobench::harness
