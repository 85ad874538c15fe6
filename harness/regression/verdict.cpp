#include "harness/regression/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/statistics/chi_square.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// How many seeds nobody runs.
constexpr double kMoreThanAnybodyRuns = 1e6;

/// Values of both results on the same seeds; NaN where there is none.
struct Pairs {
  std::vector<double> first;
  std::vector<double> second;
};

/// A seed that both results have, and its places there.
struct SharedSeed {
  std::uint64_t seed = 0;
  std::size_t in_first = 0;
  std::size_t in_second = 0;
};

/// The values of a metric at some seeds. @return empty where the result does not have it
std::vector<double> values_at(const SeedMetrics& metrics, const std::string& metric,
                              const std::vector<SharedSeed>& seeds, std::size_t SharedSeed::*place) {
  const auto found = metrics.find(metric);
  std::vector<double> values;
  if (found == metrics.end()) return values;
  for (const SharedSeed& seed : seeds) values.push_back(found->second[seed.*place]);
  return values;
}

bool has_value(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

bool are_equal(const Pairs& pairs) {
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const bool neither = std::isnan(pairs.first[i]) && std::isnan(pairs.second[i]);
    if (!neither && pairs.first[i] != pairs.second[i]) return false;
  }
  return true;
}

/// About how many seeds there must be in all until the interval lies on one side of what it straddles.
double seeds_needed(const MetricVerdict& metric, double sd, double alpha) {
  const double off = std::abs(std::abs(metric.change) - metric.margin);
  const double reach = student_t_quantile(1.0 - alpha, std::max(1L, metric.pairs - 1)) * sd;
  return reach / off * (reach / off);
}

/// @return how many seeds there must be for a p-value that is small enough among so many metrics: that of
/// changes which all go one way is 2^(1 - seeds)
long fewest_that_tell(long metrics, double alpha) {
  long seeds = 1;
  for (double p = static_cast<double>(metrics); p >= alpha; p *= 0.5) ++seeds;
  return seeds;
}

/// Fills in all that does not depend on other metrics.
MetricVerdict measure(const std::string& name, const Pairs& pairs, const MetricRule& rule, double alpha) {
  MetricVerdict metric{.metric = name, .equal = are_equal(pairs)};
  std::vector<double> first, second, first_badness, changes;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const double before = badness(rule, pairs.first[i]);
    const double change = badness(rule, pairs.second[i]) - before;
    if (!std::isfinite(change)) continue;
    first.push_back(pairs.first[i]);
    second.push_back(pairs.second[i]);
    first_badness.push_back(before);
    changes.push_back(change);
  }
  metric.pairs = static_cast<long>(changes.size());
  metric.first_mean = summarise(first).mean;
  metric.second_mean = summarise(second).mean;
  metric.change = summarise(changes).mean;
  const double scale = std::abs(summarise(first_badness).mean);
  metric.margin = std::max(rule.absolute_margin, rule.relative_margin * scale);
  if (metric.margin > rule.absolute_margin) metric.scale = scale;
  metric.interval = mean_interval(changes, 1.0 - alpha);
  metric.p = wilcoxon_signed_rank(changes);
  const double needed = seeds_needed(metric, summarise(changes).sd, alpha);
  if (needed < kMoreThanAnybodyRuns) metric.more_seeds = std::max(1L, std::lround(needed) - metric.pairs);
  return metric;
}

Verdict judge(const MetricVerdict& metric, double alpha) {
  if (metric.equal) return Verdict::kPass;
  if (metric.pairs == 0) return Verdict::kInconclusive;
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

/// A metric that one of the results has no value of.
MetricVerdict one_sided(const std::string& name, const Pairs& pairs) {
  const bool vanished = has_value(pairs.first);
  return {.metric = name,
          .verdict = vanished ? Verdict::kVanished : Verdict::kNew,
          .first_mean = summarise(pairs.first).mean,
          .second_mean = summarise(pairs.second).mean,
          .change = kNone,
          .interval = {kNone, kNone},
          .margin = kNone};
}

void add_metric(const std::string& name, const Pairs& pairs, const VerdictSettings& settings,
                ResultComparison& comparison) {
  const bool in_first = has_value(pairs.first);
  const bool in_second = has_value(pairs.second);
  if (!in_first && !in_second) return;
  const std::optional<MetricRule> rule = rule_of(name, settings.margins);
  if (!rule) {
    if (in_first != in_second || !are_equal(pairs)) comparison.conditions.push_back(name);
  } else if (in_first && in_second) {
    comparison.metrics.push_back(measure(name, pairs, *rule, settings.alpha));
  } else {
    comparison.metrics.push_back(one_sided(name, pairs));
  }
}

/// Puts the p-values of counts in place of those of the seeds' rates.
void take_counts(ResultComparison& comparison, const PairedCounts& counts) {
  for (MetricVerdict& metric : comparison.metrics) {
    const auto found = counts.find(metric.metric);
    if (found == counts.end()) continue;
    metric.count = found->second;
    metric.p = mcnemar(found->second);
  }
}

void decide(ResultComparison& comparison, double alpha) {
  std::vector<double> p_values;
  const auto was_tested = [](const MetricVerdict& metric) { return metric.pairs > 0 && !metric.equal; };
  for (const MetricVerdict& metric : comparison.metrics)
    if (was_tested(metric)) p_values.push_back(metric.p);
  comparison.changed = static_cast<long>(p_values.size());
  const std::vector<double> corrected = holm(p_values);
  auto next = corrected.begin();
  for (MetricVerdict& metric : comparison.metrics) {
    if (was_tested(metric)) metric.p_holm = *next++;
    if (metric.verdict == Verdict::kPass) metric.verdict = judge(metric, alpha);
    if (metric.verdict != Verdict::kInconclusive) metric.more_seeds.reset();
    if (metric.more_seeds && !metric.count && std::abs(metric.change) > metric.margin)
      metric.more_seeds =
          std::max(*metric.more_seeds, fewest_that_tell(comparison.changed, alpha) - metric.pairs);
  }
  std::ranges::stable_sort(comparison.metrics, {}, &MetricVerdict::verdict);
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
  ResultComparison comparison;
  for (const SharedSeed& shared : seeds) comparison.seeds.push_back(shared.seed);
  for (const std::string& name : names_of_both(first, second)) {
    if (!fits(name, settings.only)) continue;
    const Pairs pairs{values_at(first.metrics, name, seeds, &SharedSeed::in_first),
                      values_at(second.metrics, name, seeds, &SharedSeed::in_second)};
    add_metric(name, pairs, settings, comparison);
  }
  if (comparison.metrics.empty())
    throw std::runtime_error(
        fmt::format("no metric fits '{}' in either result: nothing to compare", settings.only));
  take_counts(comparison, counts);
  decide(comparison, settings.alpha);
  return comparison;
}

}  // namespace stereobench::harness
