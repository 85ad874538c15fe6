/// The distribution of a weighted sum of squared normals, for errors whose law is known.
#pragma once

#include <cmath>
#include <vector>

#include "slam/math/angles.h"

namespace stereobench::harness {

/// P(sum of weights * squared standard normals > x): the inversion of its characteristic function (Imhof,
/// Biometrika 48, 1961), by Simpson's rule. For weights that sum to about 1, four or more of them.
inline double quadratic_form_above(const std::vector<double>& weights, double x) {
  constexpr double kEnd = 600.0;  // there the integrand is below 1e-5, and its sign alternates
  constexpr int kSteps = 12000;   // even
  const auto integrand = [&](double u) {
    double angle = -0.5 * x * u, log_size = 0.0;
    for (const double weight : weights) {
      angle += 0.5 * std::atan(weight * u);
      log_size += 0.25 * std::log1p(weight * weight * u * u);
    }
    return std::sin(angle) / (u * std::exp(log_size));
  };
  double mean = 0.0;
  for (const double weight : weights) mean += weight;
  double sum = 0.5 * (mean - x) + integrand(kEnd);  // its limit at 0
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(kEnd * i / kSteps);
  return 0.5 + sum * kEnd / kSteps / 3.0 / slam::kPi;
}

/// The value that such a sum stays below with a probability.
inline double quadratic_form_quantile(const std::vector<double>& weights, double probability) {
  double low = 0.0, high = 40.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (quadratic_form_above(weights, middle) > 1.0 - probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The weights of the mean square of a random walk after each of n steps of variance 1 / n: the eigenvalues
/// of min(i, j) / n^2.
inline std::vector<double> random_walk_weights(int n) {
  std::vector<double> weights;
  for (int j = 1; j <= n; ++j) {
    const double sine = std::sin((2.0 * j - 1.0) * slam::kPi / (2.0 * (2.0 * n + 1.0)));
    weights.push_back(0.25 / (sine * sine) / (static_cast<double>(n) * n));
  }
  return weights;
}

}  // namespace stereobench::harness
