/// Functions whose Sobol' indices are known in closed form.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "harness/sensitivity/sensitivity.h"
#include "slam/math/random.h"

namespace stereobench::harness {

/// A metric with its indices, in the order of the factors.
struct KnownFunction {
  Factors factors;
  std::function<double(const StudyPoint&)> value;
  std::vector<double> first;
  std::vector<double> total;
};

inline std::vector<double> evaluate(const KnownFunction& function, const std::vector<StudyPoint>& points) {
  std::vector<double> values;
  for (const StudyPoint& point : points) values.push_back(function.value(point));
  return values;
}

inline Sensitivity study_of(const KnownFunction& function, const StudySettings& settings) {
  return study_sensitivity(function.factors, settings,
                           [&](const std::vector<StudyPoint>& points) { return evaluate(function, points); });
}

/// Standard normal chance of a run. @param stream tells streams of one seed apart
inline double chance_of(std::uint64_t seed, std::uint64_t stream = 0) {
  return slam::RandomStream(seed, slam::Stream::kOracle, stream).normal();
}

/// Ishigami and Homma 1990, a = 7, b = 0.1: the third key acts together with the first alone.
inline KnownFunction ishigami() {
  constexpr double pi = std::numbers::pi, a = 7.0, b = 0.1;
  const double fourth = pi * pi * pi * pi;
  const double v1 = 0.5 * (1.0 + b * fourth / 5.0) * (1.0 + b * fourth / 5.0);
  const double v2 = a * a / 8.0, v13 = 8.0 * b * b * fourth * fourth / 225.0;
  const double all = v1 + v2 + v13;
  const auto value = [](const StudyPoint& point) {
    const std::vector<double>& x = point.values;
    return std::sin(x[0]) + a * std::sin(x[1]) * std::sin(x[1]) +
           b * x[2] * x[2] * x[2] * x[2] * std::sin(x[0]);
  };
  return {.factors = {.keys = {{"x1", -pi, pi}, {"x2", -pi, pi}, {"x3", -pi, pi}}, .streams = {}},
          .value = value,
          .first = {v1 / all, v2 / all, 0.0},
          .total = {(v1 + v13) / all, v2 / all, v13 / all}};
}

/// A sum of two keys with variances 9 and 1, and of chance with variance 40. Its mean is far from 0.
inline KnownFunction sum_with_chance() {
  const double unit = std::sqrt(12.0);
  const auto value = [](const StudyPoint& point) {
    return 100.0 + 3.0 * point.values[0] + point.values[1] + std::sqrt(40.0) * chance_of(point.seeds[0]);
  };
  return {.factors = {.keys = {{"large", 0.0, unit}, {"small", 0.0, unit}}, .streams = {"seed"}},
          .value = value,
          .first = {0.18, 0.02, 0.8},
          .total = {0.18, 0.02, 0.8}};
}

/// A product of two keys of mean 1, with relative variances 1/3 and 1/12.
inline KnownFunction product() {
  const double x = 1.0 / 3.0, y = 1.0 / 12.0, all = x + y + x * y;
  return {.factors = {.keys = {{"x", 0.0, 2.0}, {"y", 0.5, 1.5}}, .streams = {}},
          .value = [](const StudyPoint& point) { return point.values[0] * point.values[1]; },
          .first = {x / all, y / all},
          .total = {x * (1.0 + y) / all, y * (1.0 + x) / all}};
}

/// Streams alone: variances 4 and 2 of one each, 1 of two together; the last one does nothing.
inline KnownFunction four_streams() {
  const auto value = [](const StudyPoint& point) {
    const double world = chance_of(point.seeds[0], 0), odometry = chance_of(point.seeds[1], 1),
                 sensor = chance_of(point.seeds[2], 2);
    return 2.0 * world + std::sqrt(2.0) * odometry + odometry * sensor;
  };
  return {.factors = {.keys = {}, .streams = {"world", "odometry", "sensor", "filter"}},
          .value = value,
          .first = {4.0 / 7.0, 2.0 / 7.0, 0.0, 0.0},
          .total = {4.0 / 7.0, 3.0 / 7.0, 1.0 / 7.0, 0.0}};
}

}  // namespace stereobench::harness
