#include "harness/history/history_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// "1 seed", "2 seeds"
std::string number_of(long count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string percent(const HistoryStep& step) {
  const double change = 100.0 * (step.after - step.before) / std::abs(step.before);
  return std::isfinite(change) ? fmt::format("{:+.3g} %", change) : "-";
}

const char* meaning_of(const HistoryStep& step) {
  if (step.is_worse()) return "worse";
  return step.is_better() ? "better" : "within the margin";
}

std::string p_cell(const HistoryStep& step) {
  return step.p == 0.0 ? "no chance in it" : fmt::format("{:.2g}", step.p);
}

Json steps_json(const MetricHistory& metric) {
  Json steps = Json::array();
  for (const HistoryStep& step : metric.steps)
    steps.push_back({{"before_result", step.result},
                     {"from_result", step.result + 1},
                     {"before", number(step.before)},
                     {"after", number(step.after)},
                     {"worse_by_margins", number(step.worse_by)},
                     {"is", meaning_of(step)},
                     {"p", step.p}});
  return steps;
}

}  // namespace

std::string result_list(std::span<const std::string> places, std::span<const std::string> scenarios,
                        std::span<const SeedTable> results) {
  std::string list;
  for (std::size_t i = 0; i < results.size(); ++i)
    list += fmt::format("{:>4}  {} ({}, {})\n", i + 1, places[i], scenarios[i],
                        number_of(std::ssize(results[i].seeds), "seed"));
  return list;
}

std::string step_table(const History& history) {
  AlignedTable table{.header = {"metric", "step", "before", "after", "change", "p", ""}};
  for (const auto& [metric, step] : steps_of(history))
    table.rows.push_back({metric->metric, fmt::format("{} to {}", step.result, step.result + 1),
                          format_number(step.before), format_number(step.after), percent(step), p_cell(step),
                          meaning_of(step)});
  return table.rows.empty() ? "" : plain_text(table);
}

std::string history_summary(const History& history, std::size_t results) {
  long with_steps = 0, changed = 0;
  std::string lost;
  for (const MetricHistory& metric : history.metrics) {
    with_steps += metric.steps.empty() ? 0 : 1;
    changed += metric.changed ? 1 : 0;
    const long without = std::ranges::count_if(metric.means, [](double mean) { return std::isnan(mean); });
    if (metric.lost > 0)
      lost += fmt::format("{}: left out {} without a value in some results\n", metric.metric,
                          number_of(metric.lost, "seed"));
    if (without > 0) lost += fmt::format("{}: no value in {}\n", metric.metric, number_of(without, "result"));
  }
  return lost + fmt::format("{} followed over {} on {}: {} changed, {} with a step\n",
                            number_of(std::ssize(history.metrics), "metric"),
                            number_of(static_cast<long>(results), "result"),
                            number_of(std::ssize(history.seeds), "seed"), changed, with_steps);
}

std::string history_warning(const History& history, const HistorySettings& settings) {
  const long seeds = std::ssize(history.seeds);
  if (history.changed == 0 || seeds >= history.fewest_seeds) return "";
  return fmt::format("warning: {} cannot tell {} from chance (alpha {:g}): {} are the fewest that can\n",
                     number_of(seeds, "seed"), number_of(history.changed, "changed metric"), settings.alpha,
                     history.fewest_seeds);
}

Json history_json(const History& history, const HistorySettings& settings,
                  std::span<const std::string> places) {
  Json metrics = Json::array();
  for (const MetricHistory& metric : history.metrics) {
    Json means = Json::array();
    for (const double mean : metric.means) means.push_back(number(mean));
    metrics.push_back({{"metric", metric.metric},
                       {"seeds", metric.seeds},
                       {"lost", metric.lost},
                       {"changed", metric.changed},
                       {"means", std::move(means)},
                       {"steps", steps_json(metric)}});
  }
  return {{"schema", 1},
          {"results", std::vector(places.begin(), places.end())},
          {"alpha", settings.alpha},
          {"seeds", history.seeds},
          {"changed", history.changed},
          {"metrics", std::move(metrics)}};
}

}  // namespace stereobench::harness
