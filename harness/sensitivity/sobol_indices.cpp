#include "harness/sensitivity/sobol_indices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Core>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kFewestRows = 10;
constexpr std::size_t kResamplesOfRows = 2000;
constexpr double kNoIndex = std::numeric_limits<double>::quiet_NaN();

/// The indices are functions of means over rows. These are of the results a of A and b of B...
enum Shared { kA, kB, kAA, kBB, kAB, kSharedCount };
/// ... and these, for each factor, of the results f of its copy.
enum OfFactor { kF, kFF, kFA, kFB, kSquaredChange, kOfFactorCount };

/// The results of a row: those of A, of B, and of each copy.
using Row = std::vector<double>;

/// The rows without a failed run.
std::vector<Row> whole_rows(std::span<const double> results, std::size_t factors) {
  const std::size_t rows = results.size() / (factors + 2);
  std::vector<Row> whole;
  for (std::size_t j = 0; j < rows; ++j) {
    Row row;
    for (std::size_t k = 0; k < factors + 2; ++k) row.push_back(results[k * rows + j]);
    if (std::ranges::all_of(row, [](double result) { return std::isfinite(result); }))
      whole.push_back(std::move(row));
  }
  return whole;
}

/// What a row adds to the means. @param origin that results are counted from, so that squares stay small
Eigen::ArrayXd terms_of(const Row& row, double origin) {
  const double a = row[0] - origin;
  const double b = row[1] - origin;
  Eigen::ArrayXd terms(kSharedCount + kOfFactorCount * (static_cast<Eigen::Index>(row.size()) - 2));
  terms.head<kSharedCount>() << a, b, a * a, b * b, a * b;
  for (std::size_t i = 2; i < row.size(); ++i) {
    const double f = row[i] - origin;
    const auto place = kSharedCount + kOfFactorCount * (static_cast<Eigen::Index>(i) - 2);
    terms.segment<kOfFactorCount>(place) << f, f * f, f * a, f * b, (f - a) * (f - a);
  }
  return terms;
}

/// Variance of what was found in A and B together.
double variance_of(const Eigen::ArrayXd& means) {
  const double mean = 0.5 * (means[kA] + means[kB]);
  return 0.5 * (means[kAA] + means[kBB]) - mean * mean;
}

/// The mean of a quantity and of its square.
struct Spread {
  double mean = 0.0;
  double mean_square = 0.0;

  double variance() const { return mean_square - mean * mean; }
};

double correlation(const Spread& x, const Spread& y, double mean_product) {
  return (mean_product - x.mean * y.mean) / std::sqrt(x.variance() * y.variance());
}

/// First, total, interactions of one factor.
std::array<double, 3> indices_of(const Eigen::ArrayXd& means, Eigen::Index factor) {
  const auto of_factor = means.segment<kOfFactorCount>(kSharedCount + kOfFactorCount * factor);
  const Spread a{means[kA], means[kAA]}, b{means[kB], means[kBB]}, f{of_factor[kF], of_factor[kFF]};
  const double r_ab = correlation(a, b, means[kAB]);
  const double r_fa = correlation(f, a, of_factor[kFA]);
  const double r_fb = correlation(f, b, of_factor[kFB]);
  const double first = (r_fb - r_fa * r_ab) / (1.0 - r_ab * r_ab);
  const double total = 0.5 * of_factor[kSquaredChange] / variance_of(means);
  return {first, total, total - first};
}

/// What lies at a share of the way through sorted numbers.
double quantile_of_sorted(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

/// The middle part of some numbers; those that do not exist are left out.
Interval middle_of(std::vector<double> numbers, double level) {
  std::erase_if(numbers, [](double number) { return !std::isfinite(number); });
  if (numbers.empty()) return {kNoIndex, kNoIndex};
  std::ranges::sort(numbers);
  return {quantile_of_sorted(numbers, 0.5 * (1.0 - level)), quantile_of_sorted(numbers, 0.5 * (1.0 + level))};
}

/// Means over rows that are drawn with replacement.
Eigen::ArrayXd resampled_means(const std::vector<Eigen::ArrayXd>& terms, slam::RandomStream& random) {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(terms.front().size());
  for (std::size_t k = 0; k < terms.size(); ++k)
    sum += terms[static_cast<std::size_t>((terms.size() * std::uint64_t{random.bits()}) >> 32U)];
  return sum / static_cast<double>(terms.size());
}

/// The indices of all factors with their intervals.
std::vector<FactorIndices> estimate(const std::vector<Eigen::ArrayXd>& terms, const Eigen::ArrayXd& means,
                                    const Resampling& resampling) {
  const auto factors = static_cast<std::size_t>((means.size() - kSharedCount) / kOfFactorCount);
  std::vector<std::array<std::vector<double>, 3>> resampled(factors);
  slam::RandomStream random(resampling.seed, slam::Stream::kResample, 1);  // 0: the shifts of the points
  for (std::size_t k = 0; k < kResamplesOfRows; ++k) {
    const Eigen::ArrayXd drawn = resampled_means(terms, random);
    for (std::size_t i = 0; i < factors; ++i) {
      const std::array<double, 3> indices = indices_of(drawn, static_cast<Eigen::Index>(i));
      for (std::size_t kind = 0; kind < indices.size(); ++kind) resampled[i][kind].push_back(indices[kind]);
    }
  }
  std::vector<FactorIndices> estimates;
  for (std::size_t i = 0; i < factors; ++i) {
    const auto [first, total, interactions] = indices_of(means, static_cast<Eigen::Index>(i));
    const auto& [firsts, totals, rests] = resampled[i];
    estimates.push_back({{first, middle_of(firsts, resampling.level)},
                         {total, middle_of(totals, resampling.level)},
                         {interactions, middle_of(rests, resampling.level)}});
  }
  return estimates;
}

}  // namespace

SobolIndices sobol_indices(std::span<const double> results, std::size_t factors,
                           const Resampling& resampling) {
  if (results.size() % (factors + 2) != 0)
    throw std::invalid_argument("sobol_indices: expected factors + 2 results a row");
  if (!(resampling.level >= 0.5 && resampling.level <= 0.99))
    throw std::invalid_argument("sobol_indices: expected a level of 0.5 to 0.99");
  const std::vector<Row> rows = whole_rows(results, factors);
  SobolIndices indices;
  indices.rows = rows.size();
  indices.rows_left_out = results.size() / (factors + 2) - rows.size();
  indices.failed_runs = static_cast<std::size_t>(
      std::ranges::count_if(results, [](double result) { return !std::isfinite(result); }));
  indices.factors.resize(factors);
  if (rows.size() < kFewestRows) return indices;
  const double origin = rows.front().front();
  std::vector<Eigen::ArrayXd> terms;
  for (const Row& row : rows) terms.push_back(terms_of(row, origin));
  Eigen::ArrayXd means = Eigen::ArrayXd::Zero(terms.front().size());
  for (const Eigen::ArrayXd& term : terms) means += term;
  means /= static_cast<double>(terms.size());
  indices.mean = origin + 0.5 * (means[kA] + means[kB]);
  indices.sd = std::sqrt(std::max(0.0, variance_of(means)));
  if (indices.sd > 0.0) indices.factors = estimate(terms, means, resampling);
  return indices;
}

}  // namespace stereobench::harness
