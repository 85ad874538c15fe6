#include "harness/response/floor_and_slope.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>
#include <boost/math/tools/toms748_solve.hpp>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr double kLowest = 1e-9;
constexpr double kHighest = 1e4;

/// What is fitted: the levels that have a weight.
struct MeanSquares {
  Eigen::ArrayXd squared_levels;
  Eigen::ArrayXd values;
  Eigen::ArrayXd weights;  ///< their sum is 1
};

MeanSquares mean_squares_of(std::span<const double> levels, std::span<const double> values,
                            std::span<const double> weights) {
  const auto rows =
      static_cast<Eigen::Index>(std::ranges::count_if(weights, [](double weight) { return weight > 0.0; }));
  MeanSquares data{Eigen::ArrayXd(rows), Eigen::ArrayXd(rows), Eigen::ArrayXd(rows)};
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    data.squared_levels[row] = levels[i] * levels[i];
    data.values[row] = values[i];
    data.weights[row++] = weights[i];
  }
  data.weights /= data.weights.sum();
  return data;
}

/// 1 / (knee^2 + level^2), one a level.
Eigen::ArrayXd inverse_shape(const MeanSquares& data, double knee) {
  return (knee * knee + data.squared_levels).inverse();
}

/// The square of the best slope for a knee: the scale at which ratios to the law are 1 on average.
double slope_squared(const MeanSquares& data, double knee) {
  return (data.weights * data.values * inverse_shape(data, knee)).sum();
}

/// Above 0 where a larger knee fits better: half the derivative of the quasi-likelihood by the knee's
/// logarithm, at the best slope.
double score(const MeanSquares& data, double knee) {
  const Eigen::ArrayXd inverse = inverse_shape(data, knee);
  const Eigen::ArrayXd ratios = data.values * inverse;
  const double scale = (data.weights * ratios).sum();
  return knee * knee * (data.weights * inverse * (ratios / scale - 1.0)).sum();
}

/// The square of the level of a line on which the error is that of the law.
template <typename Squared>
Squared bent(const Squared& squared_level, double upper_knee) {
  return squared_level / (1.0 + squared_level / (upper_knee * upper_knee));
}

/// The deviance of the quasi-likelihood.
double deviance(const MeanSquares& data, const FloorAndSlope& law) {
  const Eigen::ArrayXd ratios =
      data.values / (law.floor * law.floor +
                     law.slope * law.slope * bent<Eigen::ArrayXd>(data.squared_levels, law.upper_knee));
  return (data.weights * (ratios - 1.0 - ratios.unaryExpr(&slam::logarithm))).sum();
}

/// From where to where knees can be told from none: beyond, the law is a line or a constant to the last bit.
struct KneeRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
};

KneeRange knee_range(const MeanSquares& data) {
  KneeRange range;
  for (const double square : data.squared_levels) {
    if (!(square > 0.0)) continue;
    range.low = std::min(range.low, kLowest * std::sqrt(square));
    range.high = std::max(range.high, kHighest * std::sqrt(square));
  }
  return range;
}

/// The knee between two at which the score is above and not above 0: its root (Alefeld, Potra and Shi 1995).
double best_knee(const MeanSquares& data, double low, double score_low, double high, double score_high) {
  constexpr double kRelativeError = 1e-9;
  std::uintmax_t most_steps = 200;  // halvings alone need 35
  const auto score_at = [&](double log_knee) { return score(data, slam::exponential(log_knee)); };
  const auto is_near = [](double below, double above) { return above - below < kRelativeError; };
  const auto [below, above] = boost::math::tools::toms748_solve(
      score_at, slam::logarithm(low), slam::logarithm(high), score_low, score_high, is_near, most_steps);
  return slam::exponential(0.5 * (below + above));
}

FloorAndSlope fit(const MeanSquares& data) {
  constexpr double kRounding = 1e-12;
  if (data.values.size() == 0) return {.floor = std::numeric_limits<double>::quiet_NaN()};
  const double constant = (data.weights * data.values).sum();
  const auto moment = [&](double origin) {
    return (data.weights * data.squared_levels * (data.values - origin)).sum();
  };
  if (!(moment(constant) > kRounding * moment(0.0))) return {.floor = std::sqrt(constant), .slope = 0.0};
  const auto [low, high] = knee_range(data);
  const double score_low = score(data, low), score_high = score(data, high);
  if (score_low <= 0.0) return {.floor = 0.0, .slope = std::sqrt(slope_squared(data, low))};
  const double knee = score_high > 0.0 ? high : best_knee(data, low, score_low, high, score_high);
  const double slope = std::sqrt(slope_squared(data, knee));
  return {.floor = knee * slope, .slope = slope};
}

}  // namespace

double FloorAndSlope::at(double level) const {
  return std::sqrt(floor * floor + slope * slope * bent(level * level, upper_knee));
}

double FloorAndSlope::knee() const {
  const double level = floor / slope;
  return level < upper_knee ? level / std::sqrt(1.0 - level * level / (upper_knee * upper_knee))
                            : std::numeric_limits<double>::infinity();
}

FloorAndSlope fit_floor_and_slope(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights) {
  return fit(mean_squares_of(levels, mean_squares, weights));
}

FloorAndSlope fit_with_upper_knee(std::span<const double> levels, std::span<const double> mean_squares,
                                  std::span<const double> weights) {
  constexpr double kStep = 1.189207115002721;  // 2^(1/4)
  const MeanSquares data = mean_squares_of(levels, mean_squares, weights);
  FloorAndSlope best = fit(data);
  double least = deviance(data, best);
  const auto [low, high] = knee_range(data);
  MeanSquares bent_data = data;
  for (double upper_knee = 0.5 * low / kLowest; upper_knee <= 4.0 * high / kHighest; upper_knee *= kStep) {
    bent_data.squared_levels = bent<Eigen::ArrayXd>(data.squared_levels, upper_knee);
    FloorAndSlope law = fit(bent_data);
    law.upper_knee = upper_knee;
    const double deviation = deviance(data, law);
    if (!(deviation < least)) continue;
    least = deviation;
    best = law;
  }
  return best;
}

}  // namespace stereobench::harness
