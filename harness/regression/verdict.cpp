#include "harness/regression/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/statistics/chi_square.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The probability of the widest interval that a bootstrap can tell.
constexpr double kWidestInterval = 0.9999;

/// How many seeds nobody runs.
constexpr double kMoreThanAnybodyRuns = 1e6;

/// A seed that both results have, and its places there.
struct SharedSeed {
  std::uint64_t seed = 0;
  std::size_t in_first = 0;
  std::size_t in_second = 0;
};

/// A metric's values at the shared seeds; NaN where there is none.
struct Pairs {
  std::vector<double> first;
  std::vector<double> second;
};

std::vector<double> values_at(const SeedMetrics& metrics, const std::string& metric,
                              const std::vector<SharedSeed>& seeds, std::size_t SharedSeed::*place) {
  const auto found = metrics.find(metric);
  std::vector<double> values;
  for (const SharedSeed& seed : seeds)
    values.push_back(found == metrics.end() ? kNone : found->second[seed.*place]);
  return values;
}

bool has_value(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

bool are_equal(const Pairs& pairs) {
  return std::ranges::equal(pairs.first, pairs.second,
                            [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

bool is_constant(const std::vector<double>& values) {
  return values.size() > 1 && std::ranges::count(values, values.front()) == std::ssize(values);
}

/// Those that both have.
Pairs complete(const Pairs& pairs) {
  Pairs both;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    if (!std::isfinite(pairs.first[i]) || !std::isfinite(pairs.second[i])) continue;
    both.first.push_back(pairs.first[i]);
    both.second.push_back(pairs.second[i]);
  }
  return both;
}

long count_lost(const Pairs& pairs) {
  long lost = 0;
  for (std::size_t i = 0; i < pairs.first.size(); ++i)
    lost += std::isfinite(pairs.first[i]) && !std::isfinite(pairs.second[i]) ? 1 : 0;
  return lost;
}

std::vector<double> differences_of(const Pairs& pairs) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < pairs.first.size(); ++i)
    differences.push_back(pairs.second[i] - pairs.first[i]);
  return differences;
}

/// @return how many seeds there must be for a p-value that is small enough among so many metrics: that of
/// changes which all go one way is 2^(1 - seeds)
long fewest_that_tell(long correction, double alpha) {
  long seeds = 1;
  for (double p = static_cast<double>(correction); p >= alpha; p *= 0.5) ++seeds;
  return seeds;
}

/// About how many more seeds there must be until the interval lies on one side of what it straddles.
std::optional<long> more_seeds_for(const MetricVerdict& metric, double standard_error, double alpha) {
  if (metric.pairs < 2) return {};
  const double off = std::abs(std::abs(metric.change) - metric.margin);
  const double half_width = student_t_bound(1.0 - alpha, metric.pairs - 1) * standard_error;
  const double needed = static_cast<double>(metric.pairs) * (half_width / off) * (half_width / off);
  if (!(needed < kMoreThanAnybodyRuns)) return {};
  return std::max(1L, std::lround(needed) - metric.pairs);
}

/// Fills in all that does not depend on other metrics.
/// @param scale the mean that a relative margin is a share of
MetricVerdict measure(const std::string& name, const Pairs& all, const MetricRule& rule, double scale,
                      double alpha) {
  const Pairs pairs = complete(all);
  const Change change = [&rule](double first, double second) {
    return badness(rule, second) - badness(rule, first);
  };
  MetricVerdict metric{.metric = name,
                       .pairs = std::ssize(pairs.first),
                       .lost = count_lost(all),
                       .equal = are_equal(all),
                       .first_mean = summarise(pairs.first.empty() ? all.first : pairs.first).mean,
                       .second_mean = summarise(pairs.second.empty() ? all.second : pairs.second).mean};
  metric.change = change(metric.first_mean, metric.second_mean);
  metric.margin = std::max(rule.absolute_margin, rule.relative_margin * scale);
  if (metric.margin > rule.absolute_margin) metric.scale = scale;
  metric.interval =
      change_interval(pairs.first, pairs.second, std::min(1.0 - alpha, kWidestInterval), change);
  metric.more_seeds = more_seeds_for(metric, standard_error(pairs.first, pairs.second, change), alpha);
  if (metric.equal || pairs.first.empty()) return metric;
  metric.test = ChangeTest::kWilcoxon;
  metric.p = wilcoxon_signed_rank(differences_of(pairs));
  return metric;
}

/// A change in which no chance is at work is as large as it is.
void take_as_exact(MetricVerdict& metric) {
  metric.test = ChangeTest::kExact;
  metric.p = metric.p_holm = 0.0;
  metric.interval = {metric.change, metric.change};
}

Verdict judge(const MetricVerdict& metric, double alpha) {
  if (metric.equal) return Verdict::kPass;
  if (metric.lost > 0) return Verdict::kVanished;
  if (metric.pairs == 0) return Verdict::kNew;
  if (!std::isfinite(metric.change)) return Verdict::kInconclusive;
  if (metric.interval.low > -metric.margin && metric.interval.high < metric.margin) return Verdict::kPass;
  if (metric.p_holm >= alpha) return Verdict::kInconclusive;
  if (metric.interval.low > metric.margin) return Verdict::kRegressed;
  return metric.interval.high < -metric.margin ? Verdict::kImproved : Verdict::kInconclusive;
}

/// @return in ascending order
std::vector<SharedSeed> shared_seeds(const SeedTable& first, const SeedTable& second) {
  std::map<std::uint64_t, std::size_t> place_in_second;
  for (std::size_t i = 0; i < second.seeds.size(); ++i) place_in_second[second.seeds[i]] = i;
  std::vector<SharedSeed> shared;
  for (std::size_t i = 0; i < first.seeds.size(); ++i)
    if (const auto other = place_in_second.find(first.seeds[i]); other != place_in_second.end())
      shared.push_back({first.seeds[i], i, other->second});
  std::ranges::sort(shared, {}, &SharedSeed::seed);
  if (shared.empty()) throw std::runtime_error("the two results have no seed in common: nothing to compare");
  return shared;
}

std::set<std::string> names_of_both(const SeedTable& first, const SeedTable& second) {
  std::set<std::string> names;
  for (const SeedMetrics* metrics : {&first.metrics, &second.metrics})
    for (const auto& [name, values] : *metrics) names.insert(name);
  return names;
}

bool is_tested(const MetricVerdict& metric) {
  return metric.test == ChangeTest::kWilcoxon || metric.test == ChangeTest::kMcnemar;
}

/// How many p-values were corrected, and by how much the smallest one was at most.
struct Correction {
  long tested = 0;
  long largest = 0;
};

/// Corrects the p-values of each family by Holm, and for the number of families that there are.
Correction correct(std::vector<MetricVerdict>& metrics) {
  std::map<MetricFamily, std::vector<MetricVerdict*>> families;
  for (MetricVerdict& metric : metrics) families[family_of(metric.metric)].push_back(&metric);
  Correction correction;
  for (const auto& [family, members] : families) {
    std::vector<double> p_values;
    for (const MetricVerdict* metric : members)
      if (is_tested(*metric)) p_values.push_back(metric->p);
    correction.tested += std::ssize(p_values);
    correction.largest =
        std::max(correction.largest, static_cast<long>(std::ssize(p_values) * std::ssize(families)));
    const std::vector<double> corrected = holm(p_values);
    auto next = corrected.begin();
    for (MetricVerdict* metric : members)
      if (is_tested(*metric)) metric->p_holm = std::min(1.0, *next++ * static_cast<double>(families.size()));
  }
  return correction;
}

/// Corrects p-values for their number, and judges.
void decide(ResultComparison& comparison, double alpha) {
  const Correction correction = correct(comparison.metrics);
  comparison.changed = correction.tested;
  comparison.fewest_seeds = fewest_that_tell(correction.largest, alpha);
  for (MetricVerdict& metric : comparison.metrics) {
    metric.verdict = judge(metric, alpha);
    const bool is_beyond = std::abs(metric.change) > metric.margin;
    const bool is_hopeless = metric.test == ChangeTest::kMcnemar && is_beyond;
    if (metric.verdict != Verdict::kInconclusive || is_hopeless) metric.more_seeds.reset();
    if (metric.more_seeds && is_beyond)
      metric.more_seeds = std::max(*metric.more_seeds, comparison.fewest_seeds - metric.pairs);
  }
  std::ranges::stable_sort(comparison.metrics, {}, [](const MetricVerdict& metric) {
    return std::pair(metric.verdict, rank_of(metric.metric));
  });
}

/// A metric that counts single things is judged by them.
void take_count(const MetricCount& counted, std::size_t seeds, double alpha, MetricVerdict& metric) {
  metric.test = ChangeTest::kMcnemar;
  metric.count = counted.count;
  metric.p = mcnemar(counted.count);
  const double all = static_cast<double>(counted.count.total);
  const double unit = counted.is_rate ? 1.0 : all / static_cast<double>(seeds);
  const Interval share = paired_share_interval(counted.count, 1.0 - alpha);
  const Interval pooled = {unit * share.low, unit * share.high};
  // Seeds of very different numbers of balls: the mean of their rates is not the rate of all.
  if (pooled.low <= metric.change && metric.change <= pooled.high) metric.interval = pooled;
}

[[noreturn]] void refuse_nothing(const ResultComparison& comparison, const std::vector<std::string>& only) {
  const std::string asked = only.empty() ? "*" : fmt::format("{}", fmt::join(only, "', '"));
  if (comparison.not_judged.empty())
    throw std::runtime_error(fmt::format("no metric fits '{}' in either result: nothing to compare", asked));
  throw std::runtime_error(
      fmt::format("what fits '{}' is neither better nor worse, and not judged: nothing to compare", asked));
}

}  // namespace

const char* text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kRegressed:
      return "REGRESSED";
    case Verdict::kVanished:
      return "VANISHED";
    case Verdict::kInconclusive:
      return "INCONCLUSIVE";
    case Verdict::kImproved:
      return "IMPROVED";
    case Verdict::kNew:
      return "NEW";
    case Verdict::kPass:
      break;
  }
  return "PASS";
}

bool ResultComparison::has(Verdict verdict) const {
  return std::ranges::count(metrics, verdict, &MetricVerdict::verdict) > 0;
}

ResultComparison compare_results(const SeedTable& first, const SeedTable& second,
                                 const VerdictSettings& settings, const PairedCounts& counts) {
  const std::vector<SharedSeed> seeds = shared_seeds(first, second);
  const bool is_one_log = first.is_one_log && second.is_one_log;
  ResultComparison comparison;
  for (const SharedSeed& shared : seeds) comparison.seeds.push_back(shared.seed);
  for (const std::string& name : names_of_both(first, second)) {
    const Pairs pairs{values_at(first.metrics, name, seeds, &SharedSeed::in_first),
                      values_at(second.metrics, name, seeds, &SharedSeed::in_second)};
    if (!fits_any(name, settings.only) || (!has_value(pairs.first) && !has_value(pairs.second))) continue;
    const std::optional<MetricRule> rule = rule_of(name, settings.margins);
    if (!rule) {
      if (!are_equal(pairs)) comparison.not_judged.push_back(name);
      continue;
    }
    const Summary scale = summarise(values_at(first.metrics, scale_of(name), seeds, &SharedSeed::in_first));
    const double share_of = scale.count > 0 ? std::abs(scale.mean) : 0.0;
    MetricVerdict metric = measure(name, pairs, *rule, share_of, settings.alpha);
    const auto counted = counts.find(name);
    if (is_one_log && is_constant(pairs.first) && is_constant(pairs.second) && !metric.equal) {
      take_as_exact(metric);
    } else if (counted != counts.end() && metric.test == ChangeTest::kWilcoxon) {
      take_count(counted->second, seeds.size(), settings.alpha, metric);
    }
    comparison.metrics.push_back(std::move(metric));
  }
  if (comparison.metrics.empty()) refuse_nothing(comparison, settings.only);
  decide(comparison, settings.alpha);
  return comparison;
}

void check_margins(const ResultComparison& comparison, const std::vector<Margin>& margins) {
  for (const Margin& margin : margins) {
    const auto is_its = [&](const MetricVerdict& metric) { return fits(metric.metric, margin.pattern); };
    if (std::ranges::none_of(comparison.metrics, is_its))
      throw std::runtime_error(
          fmt::format("--margin: no metric that is judged fits '{}'; --all lists them", margin.pattern));
  }
}

}  // namespace stereobench::harness
