#include "harness/detector_noise/noise_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/LU>

#include "harness/statistics/chi_square.h"
#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/noise_law.h"

namespace stereobench::harness {
namespace {

constexpr int kReweightings = 50;

/// What of a standard normal's squares lies half below, and what filters would still believe.
const double kMedianOfSquares = chi_square_quantile(0.5, 1);
const double kFarthestSquare = chi_square_quantile(slam::FilterConfig{}.gate_probability, 1);

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The mean of squares that are chi-square's of one degree of freedom times a number, to that number.
double robust_scale2(const std::vector<double>& squares) {
  const double limit = kFarthestSquare * median(squares) / kMedianOfSquares;
  double sum = 0.0;
  long count = 0;
  for (const double square : squares) {
    if (!(square <= limit)) continue;
    sum += square;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

/// Variance of a range error as a + b r^4, both at least 0: regression of the squares on (1, r^4), each
/// weighed by the inverse of its variance, twice the square of its mean.
Eigen::Vector2d fit_range_variance(std::span<const CalibrationSample> samples) {
  std::vector<double> squares, growth;
  for (const CalibrationSample& sample : samples) {
    squares.push_back(sample.error.x() * sample.error.x());
    const double range2 = sample.truth.x() * sample.truth.x();
    growth.push_back(range2 * range2);
  }
  if (squares.empty()) return Eigen::Vector2d::Zero();
  std::vector<double> relative;
  for (std::size_t i = 0; i < squares.size(); ++i) relative.push_back(squares[i] / growth[i]);
  Eigen::Vector2d law(0.0, median(relative) / kMedianOfSquares);
  const double least = 1e-6 * law.y() * median(growth);
  for (int pass = 0; pass < kReweightings; ++pass) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const Eigen::Vector2d by_law(1.0, growth[i]);
      const double variance = std::max(law.dot(by_law), least);
      if (squares[i] > kFarthestSquare * variance) continue;
      normal += by_law * by_law.transpose() / (variance * variance);
      right += by_law * squares[i] / (variance * variance);
    }
    if (!(normal.determinant() > 0.0)) break;
    const Eigen::Vector2d free = normal.inverse() * right;
    law = free;
    if (free.x() < 0.0) law = {0.0, right.y() / normal(1, 1)};
    if (free.y() < 0.0) law = {right.x() / normal(0, 0), 0.0};
  }
  return law;
}

double squared_length(const CalibrationSample& sample, const Eigen::Matrix2d& covariance) {
  return sample.error.dot(covariance.inverse() * sample.error);
}

double correlation(const Eigen::Matrix2d& covariance) {
  return covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
}

/// The spread of errors about their mean.
struct Spread {
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
  Eigen::Vector2d sd = Eigen::Vector2d::Zero();
  Eigen::Vector2d over_bound = Eigen::Vector2d::Zero();
  Eigen::Vector2d over_unknown_size = Eigen::Vector2d::Zero();
  double correlation = 0.0;  ///< of errors in units of what is stated of them
};

Spread spread_of(std::span<const CalibrationSample* const> samples) {
  Spread spread;
  const auto count = static_cast<double>(samples.size());
  for (const CalibrationSample* sample : samples) spread.bias += sample->error / count;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  Eigen::Vector2d bounded_squares = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares_of_unknown_size = Eigen::Vector2d::Zero();
  Eigen::Matrix2d pulls = Eigen::Matrix2d::Zero();
  long bounded = 0;
  for (const CalibrationSample* sample : samples) {
    const Eigen::Vector2d off = sample->error - spread.bias;
    squares += off.cwiseAbs2();
    const Eigen::Vector2d pull = off.cwiseQuotient(sample->stated.diagonal().cwiseSqrt());
    pulls += pull * pull.transpose();
    const BallBounds& bounds = sample->bounds;
    if (!(bounds.of_size.determinant() > 0.0)) continue;
    bounded_squares += off.cwiseAbs2().cwiseQuotient(bounds.of_size.diagonal());
    squares_of_unknown_size += off.cwiseAbs2().cwiseQuotient(bounds.unknown_size.diagonal());
    ++bounded;
  }
  spread.sd = (squares / (count - 1.0)).cwiseSqrt();
  spread.over_bound = (bounded_squares / static_cast<double>(bounded)).cwiseSqrt();  // 0 / 0 without a bound
  spread.over_unknown_size = (squares_of_unknown_size / static_cast<double>(bounded)).cwiseSqrt();
  spread.correlation = correlation(pulls);
  return spread;
}

CalibrationBin summarise(std::span<const CalibrationSample* const> samples, const FittedNoise& noise) {
  const double gate = slam::chi_square_2_quantile(slam::FilterConfig{}.gate_probability);
  CalibrationBin bin;
  double stated_correlation = 0.0;
  std::vector<double> disparity_errors_px, radius_squares_px2;
  std::vector<const CalibrationSample*> believed;
  for (const CalibrationSample* sample : samples) {
    ++bin.samples;
    if (!(squared_length(*sample, covariance_of(*sample, noise, NoiseKind::kScaled)) <= gate)) {
      ++bin.refused;
      continue;
    }
    believed.push_back(sample);
    stated_correlation += correlation(sample->stated);
    disparity_errors_px.push_back(sample->disparity_error_px);
    radius_squares_px2.push_back(sample->radius_error_px.squaredNorm() / 2.0);
    for (const NoiseKind kind : {NoiseKind::kStated, NoiseKind::kScaled, NoiseKind::kStereo})
      bin.half_nis[static_cast<int>(kind)] +=
          squared_length(*sample, covariance_of(*sample, noise, kind)) / 2.0;
  }
  const auto used = static_cast<double>(believed.size());
  const Spread spread = spread_of(believed);
  bin.bias = used > 0.0 ? spread.bias : Eigen::Vector2d::Constant(std::nan(""));
  bin.sd = spread.sd;
  bin.over_bound = spread.over_bound;
  bin.over_unknown_size = spread.over_unknown_size;
  bin.half_nis /= used;
  bin.correlation = {spread.correlation, stated_correlation / used};
  bin.disparity_error_px = harness::summarise(disparity_errors_px);
  bin.radius_rms_px = std::sqrt(harness::summarise(radius_squares_px2).mean);
  return bin;
}

}  // namespace

FittedNoise fit_noise(std::span<const CalibrationSample> samples) {
  FittedNoise fitted;
  std::array<std::vector<double>, 2> relative;
  std::vector<double> bearing_squares;
  for (const CalibrationSample& sample : samples) {
    for (int axis = 0; axis < 2; ++axis) {
      const double square = sample.error[axis] * sample.error[axis];
      if (sample.stated(axis, axis) > 0.0)
        relative[static_cast<std::size_t>(axis)].push_back(square / sample.stated(axis, axis));
      if (axis == 1) bearing_squares.push_back(square);
    }
  }
  if (samples.empty()) return fitted;
  for (int axis = 0; axis < 2; ++axis)
    fitted.stated_sd_scale[axis] = std::sqrt(robust_scale2(relative[static_cast<std::size_t>(axis)]));
  const Eigen::Vector2d law = fit_range_variance(samples);
  fitted.stereo = {.range_sd_m = std::sqrt(law.x()),
                   .range_sd_per_m2 = std::sqrt(law.y()),
                   .bearing_sd_rad = std::sqrt(robust_scale2(bearing_squares))};
  return fitted;
}

Eigen::Matrix2d covariance_of(const CalibrationSample& sample, const FittedNoise& noise, NoiseKind kind) {
  slam::FilterConfig config;
  config.range_floor_m = 0.0;
  config.bearing_floor_rad = 0.0;
  if (kind == NoiseKind::kScaled) config.stated_sd_scale = noise.stated_sd_scale;
  if (kind == NoiseKind::kStereo) config.noise_law = noise.stereo;
  slam::RangeBearing seen;
  seen.covariance = sample.stated;
  return slam::noise_at(slam::observe(seen, config), sample.truth);
}

std::vector<CalibrationBin> bin_samples(std::span<const CalibrationSample> samples, const FittedNoise& noise,
                                        double nearest_m, double farthest_m, int count) {
  const auto edge = [&](int i) {
    return nearest_m * slam::power(farthest_m / nearest_m, static_cast<double>(i) / count);
  };
  const auto take = [&](double from, double to, bool whole) {
    std::vector<const CalibrationSample*> taken;
    for (const CalibrationSample& sample : samples)
      if (sample.whole == whole && sample.depth_m >= from && sample.depth_m < to) taken.push_back(&sample);
    CalibrationBin bin = summarise(taken, noise);
    bin.nearest_m = from;
    bin.farthest_m = to;
    bin.whole = whole;
    return bin;
  };
  std::vector<CalibrationBin> bins;
  for (int i = 0; i < count; ++i) bins.push_back(take(edge(i), edge(i + 1), true));
  bins.push_back(take(0.0, std::numeric_limits<double>::infinity(), false));
  return bins;
}

}  // namespace stereobench::harness
