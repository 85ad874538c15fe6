#include "harness/statistics/paired.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

/// The differences that are not zero, by size.
std::vector<double> sorted_by_size(std::span<const double> differences) {
  std::vector<double> sorted;
  for (const double difference : differences)
    if (std::isfinite(difference) && difference != 0.0) sorted.push_back(difference);
  std::sort(sorted.begin(), sorted.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return sorted;
}

/// Ranks of differences by their size. Ties share their mean rank; twice the rank is a whole number.
struct SignedRanks {
  std::vector<std::size_t> twice;  ///< of all differences
  std::size_t twice_positive = 0;  ///< sum over those that are positive
  double ties = 0.0;               ///< sum of t^3 - t over groups of t equal sizes
};

SignedRanks rank(const std::vector<double>& sorted) {
  SignedRanks ranks;
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    while (end < sorted.size() && std::abs(sorted[end]) == std::abs(sorted[begin])) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      ranks.twice.push_back(begin + 1 + end);
      if (sorted[i] > 0.0) ranks.twice_positive += ranks.twice.back();
    }
    const auto count = static_cast<double>(end - begin);
    ranks.ties += count * count * count - count;
    begin = end;
  }
  return ranks;
}

/// The chance that the smaller of both rank sums is at most this, by counting all signs: the number of
/// subsets of the ranks with each sum, added up one rank after the other.
double exact_p(const SignedRanks& ranks) {
  const std::size_t all = std::accumulate(ranks.twice.begin(), ranks.twice.end(), std::size_t{0});
  std::vector<double> ways(all + 1, 0.0);
  ways[0] = 1.0;
  for (const std::size_t twice_rank : ranks.twice)
    for (std::size_t sum = all; sum >= twice_rank; --sum) ways[sum] += ways[sum - twice_rank];
  const std::size_t smaller = std::min(ranks.twice_positive, all - ranks.twice_positive);
  double below = 0.0;
  for (std::size_t sum = 0; sum <= smaller; ++sum) below += ways[sum];
  return std::min(1.0, 2.0 * std::ldexp(below, -static_cast<int>(ranks.twice.size())));
}

double normal_p(const SignedRanks& ranks, double n) {
  const double mean = n * (n + 1.0) / 4.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranks.ties / 48.0;
  const double positive = 0.5 * static_cast<double>(ranks.twice_positive);
  const double off = std::max(0.0, std::abs(positive - mean) - 0.5);
  return slam::complementary_error(off / std::sqrt(variance) / std::numbers::sqrt2);
}

/// The score statistic of a difference of paired shares, a standard normal where it is the true one.
double share_score(const PairedCount& count, double difference) {
  const auto n = static_cast<double>(count.total), worse = static_cast<double>(count.worse),
             better = static_cast<double>(count.better);
  const double a = 2.0 * n, b = (2.0 * n - worse + better) * difference - worse - better,
               c = -better * difference * (1.0 - difference);
  const double share_better = (std::sqrt(std::max(0.0, b * b - 4.0 * a * c)) - b) / (2.0 * a);
  const double variance = n * (2.0 * share_better + difference * (1.0 - difference));
  const double excess = worse - better - n * difference;
  return variance > 0.0 ? excess / std::sqrt(variance) : excess > 0.0 ? 1e300 : -1e300;
}

/// Where the score, which falls, is `level`. @return within [low, high]
double where_score_is(const PairedCount& count, double level, double low, double high) {
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (share_score(count, middle) > level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double wilcoxon_signed_rank(std::span<const double> differences) {
  constexpr std::size_t kMostForExact = 50;
  const std::vector<double> sorted = sorted_by_size(differences);
  if (sorted.empty()) return 1.0;
  const SignedRanks ranks = rank(sorted);
  if (sorted.size() > kMostForExact) return normal_p(ranks, static_cast<double>(sorted.size()));
  return exact_p(ranks);
}

double mcnemar(const PairedCount& count) {
  const long differ = count.worse + count.better;
  if (differ == 0) return 1.0;
  const boost::math::binomial fair(static_cast<double>(differ), 0.5);
  const auto fewer = static_cast<double>(std::min(count.worse, count.better));
  return std::min(1.0, 2.0 * boost::math::cdf(fair, fewer));
}

PairedDifference compare_paired(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) throw std::invalid_argument("compare_paired: expected the same seeds");
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(first[i] - second[i]);
  return {summarise(differences), wilcoxon_signed_rank(differences)};
}

Interval paired_share_interval(const PairedCount& count, double probability) {
  const boost::math::normal normal;
  const double bound = boost::math::quantile(normal, 0.5 + 0.5 * probability);
  const double found = static_cast<double>(count.worse - count.better) / static_cast<double>(count.total);
  return {where_score_is(count, bound, -1.0, found), where_score_is(count, -bound, found, 1.0)};
}

}  // namespace stereobench::harness
