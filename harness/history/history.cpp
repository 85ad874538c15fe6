#include "harness/history/history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/statistics/change_point.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Of each result the place of each shared seed.
using Places = std::vector<std::vector<std::size_t>>;

std::vector<std::uint64_t> shared_seeds(std::span<const SeedTable> results) {
  std::map<std::uint64_t, std::size_t> results_with;
  for (const SeedTable& result : results)
    for (const std::uint64_t seed : result.seeds) ++results_with[seed];
  std::vector<std::uint64_t> shared;
  for (const auto& [seed, count] : results_with)
    if (count == results.size()) shared.push_back(seed);
  if (shared.empty())
    throw std::runtime_error("the results have no seed in common: there is nothing to follow");
  return shared;
}

Places places_of(std::span<const SeedTable> results, const std::vector<std::uint64_t>& seeds) {
  Places places;
  for (const SeedTable& result : results) {
    std::vector<std::size_t>& of_result = places.emplace_back();
    for (const std::uint64_t seed : seeds) {
      const auto found = std::ranges::find(result.seeds, seed);
      of_result.push_back(static_cast<std::size_t>(found - result.seeds.begin()));
    }
  }
  return places;
}

/// A metric's values, in those results that have any.
struct Values {
  std::vector<std::size_t> results;
  std::vector<Series> seeds;  ///< those with a value in all of these results
  long lost = 0;
};

Values values_of(std::span<const SeedTable> results, const Places& places, const std::string& metric) {
  std::vector<std::vector<double>> columns;
  Values values;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto found = results[i].metrics.find(metric);
    if (found == results[i].metrics.end()) continue;
    std::vector<double> column;
    for (const std::size_t place : places[i]) column.push_back(found->second[place]);
    if (std::ranges::none_of(column, [](double value) { return std::isfinite(value); })) continue;
    values.results.push_back(i);
    columns.push_back(std::move(column));
  }
  if (columns.empty()) return values;
  for (std::size_t seed = 0; seed < places.front().size(); ++seed) {
    Series series;
    for (const std::vector<double>& column : columns) series.push_back(column[seed]);
    if (std::ranges::all_of(series, [](double value) { return std::isfinite(value); }))
      values.seeds.push_back(std::move(series));
    else if (std::ranges::any_of(series, [](double value) { return std::isfinite(value); }))
      ++values.lost;
  }
  return values;
}

/// Over the seeds; NaN where a result has no value.
std::vector<double> means_of(const Values& values, std::size_t results) {
  std::vector<double> means(results, kNoValue);
  for (std::size_t i = 0; i < values.results.size(); ++i) {
    std::vector<double> column;
    for (const Series& series : values.seeds) column.push_back(series[i]);
    means[values.results[i]] = summarise(column).mean;
  }
  return means;
}

bool changes(const Values& values) {
  return std::ranges::any_of(values.seeds, [](const Series& series) {
    return std::ranges::count(series, series.front()) < std::ssize(series);
  });
}

/// Repetitions of a filter without random numbers.
bool is_without_chance(std::span<const SeedTable> results, const Values& values) {
  const bool all_logs = std::ranges::all_of(results, &SeedTable::is_one_log);
  return all_logs && std::ranges::all_of(
                         values.seeds, [&](const Series& series) { return series == values.seeds.front(); });
}

std::vector<ChangePoint> all_changes(const Series& series) {
  std::vector<ChangePoint> found;
  for (std::size_t i = 1; i < series.size(); ++i)
    if (series[i] != series[i - 1]) found.push_back({i, 0.0});
  return found;
}

/// The mean of those results from one up to another that have a value.
double level_of(const std::vector<double>& means, std::size_t begin, std::size_t end) {
  return summarise(std::span(means).subspan(begin, end - begin)).mean;
}

double worse_by(const MetricRule& rule, double before, double after, double scale) {
  const double change = badness(rule, after) - badness(rule, before);
  const double margin = std::max(rule.absolute_margin, rule.relative_margin * std::abs(scale));
  if (change == 0.0) return 0.0;
  return margin > 0.0 ? change / margin : std::copysign(std::numeric_limits<double>::infinity(), change);
}

/// What is known of a metric before the number of those that changed is.
struct Followed {
  MetricHistory history;
  MetricRule rule;
  Values values;
  std::vector<double> scale_means;  ///< of the metric that relative margins are a share of
  bool is_tested = false;           ///< it changed, and chance is at work
};

void add_steps(Followed& followed, const std::vector<ChangePoint>& changes, double tests) {
  const std::vector<double>& means = followed.history.means;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::size_t at = followed.values.results[changes[i].place];
    const std::size_t end =
        i + 1 < changes.size() ? followed.values.results[changes[i + 1].place] : means.size();
    HistoryStep step{.result = at,
                     .before = level_of(means, begin, at),
                     .after = level_of(means, at, end),
                     .p = std::min(1.0, changes[i].p * tests)};
    const double scale = level_of(followed.scale_means, begin, at);
    step.worse_by = worse_by(followed.rule, step.before, step.after, std::isfinite(scale) ? scale : 0.0);
    followed.history.steps.push_back(step);
    begin = at;
  }
}

std::set<std::string> names_in(std::span<const SeedTable> results) {
  std::set<std::string> names;
  for (const SeedTable& result : results)
    for (const auto& [name, values] : result.metrics) names.insert(name);
  return names;
}

/// @throws std::runtime_error for a margin that is of no metric
void check_margins(const std::vector<Followed>& all, const std::vector<Margin>& margins) {
  for (const Margin& margin : margins)
    if (std::ranges::none_of(
            all, [&](const Followed& followed) { return fits(followed.history.metric, margin.pattern); }))
      throw std::runtime_error(fmt::format("--margin: no metric that is followed fits '{}'", margin.pattern));
}

/// Each metric that a rule judges and that two results or more have.
std::vector<Followed> follow_metrics(std::span<const SeedTable> results, const Places& places,
                                     const HistorySettings& settings) {
  std::vector<Followed> all;
  for (const std::string& name : names_in(results)) {
    const std::optional<MetricRule> rule = rule_of(name, settings.margins);
    if (!rule || !fits(name, settings.only)) continue;
    Followed followed{.rule = *rule, .values = values_of(results, places, name)};
    if (followed.values.results.size() < 2 || followed.values.seeds.empty()) continue;
    followed.history = {.metric = name,
                        .means = means_of(followed.values, results.size()),
                        .seeds = std::ssize(followed.values.seeds),
                        .lost = followed.values.lost,
                        .changed = changes(followed.values)};
    followed.scale_means = means_of(values_of(results, places, scale_of(name)), results.size());
    followed.is_tested = followed.history.changed && !is_without_chance(results, followed.values);
    all.push_back(std::move(followed));
  }
  if (all.empty())
    throw std::runtime_error(
        fmt::format("no metric that is judged fits '{}' in two results or more", settings.only));
  check_margins(all, settings.margins);
  return all;
}

}  // namespace

History history_of(std::span<const SeedTable> results, const HistorySettings& settings) {
  if (results.size() < 2)
    throw std::runtime_error("expected two results or more: there is nothing to follow");
  History history{.seeds = shared_seeds(results)};
  const Places places = places_of(results, history.seeds);
  std::vector<Followed> all = follow_metrics(results, places, settings);
  history.changed = std::ranges::count(all, true, &Followed::is_tested);
  const double tests = std::max(1.0, static_cast<double>(history.changed));
  for (Followed& followed : all) {
    if (followed.is_tested)
      add_steps(followed, find_changes(followed.values.seeds, settings.alpha / tests), tests);
    else if (followed.history.changed)
      add_steps(followed, all_changes(followed.values.seeds.front()), 1.0);
    history.metrics.push_back(std::move(followed.history));
  }
  history.fewest_seeds = fewest_seeds_for(settings.alpha / tests);
  return history;
}

std::vector<FoundStep> steps_of(const History& history) {
  std::vector<FoundStep> steps;
  for (const MetricHistory& metric : history.metrics)
    for (const HistoryStep& step : metric.steps) steps.push_back({&metric, step});
  std::ranges::stable_sort(steps, std::greater{}, [](const FoundStep& found) { return found.step.worse_by; });
  return steps;
}

bool ends_worse(const History& history) {
  return std::ranges::any_of(history.metrics, [](const MetricHistory& metric) {
    return !metric.steps.empty() && metric.steps.back().is_worse();
  });
}

}  // namespace stereobench::harness
