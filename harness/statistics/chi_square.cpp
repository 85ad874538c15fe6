#include "harness/statistics/chi_square.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/chi_squared.hpp>

namespace stereobench::harness {
namespace {

using ChiSquare = boost::math::chi_squared;

ChiSquare distribution(long degrees_of_freedom) {
  return ChiSquare(static_cast<double>(degrees_of_freedom));
}

}  // namespace

SquaredSum worth(const SquaredSum& sum, Seeds seeds, std::size_t count) {
  if (seeds == Seeds::kWorlds || count == 0) return sum;
  const auto n = static_cast<double>(count);
  return {sum.sum / n, std::lround(static_cast<double>(sum.degrees_of_freedom) / n)};
}

double chi_square_quantile(double probability, long degrees_of_freedom) {
  return boost::math::quantile(distribution(degrees_of_freedom), probability);
}

Band chi_square_band(double probability, long degrees_of_freedom) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (degrees_of_freedom < 1) return {kNone, kNone};
  const ChiSquare consistent = distribution(degrees_of_freedom);
  const double outside = 0.5 * (1.0 - probability);
  const auto count = static_cast<double>(degrees_of_freedom);
  return {boost::math::quantile(consistent, outside) / count,
          boost::math::quantile(boost::math::complement(consistent, outside)) / count};
}

double chi_square_below(const SquaredSum& sum) {
  return std::isfinite(sum.sum) ? boost::math::cdf(distribution(sum.degrees_of_freedom), sum.sum) : 1.0;
}

double chi_square_p(const SquaredSum& sum) {
  if (sum.degrees_of_freedom < 1) return 1.0;
  if (!std::isfinite(sum.sum)) return 0.0;
  const ChiSquare consistent = distribution(sum.degrees_of_freedom);
  const double above = boost::math::cdf(boost::math::complement(consistent, sum.sum));
  return std::min(1.0, 2.0 * std::min(chi_square_below(sum), above));
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(p_values[a], a) < std::pair(p_values[b], b);
  });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double left = static_cast<double>(order.size() - i);
    largest = std::max(largest, std::min(1.0, left * p_values[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

}  // namespace stereobench::harness
