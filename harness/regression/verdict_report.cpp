#include "harness/regression/verdict_report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kVerdicts = {Verdict::kRegressed, Verdict::kVanished, Verdict::kInconclusive,
                                  Verdict::kImproved,  Verdict::kNew,      Verdict::kPass};

long count_of(const ResultComparison& comparison, Verdict verdict) {
  return std::ranges::count(comparison.metrics, verdict, &MetricVerdict::verdict);
}

/// What a change is said in: hundredths of what a relative margin is a share of, else its own unit.
double unit_of_change(const MetricVerdict& metric) {
  return metric.scale > 0.0 ? 0.01 * metric.scale : 1.0;
}

std::string signed_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "-" : value < 0.0 ? "-inf" : "inf";
  return fmt::format("{:+.3g}", value);
}

/// "+12 [+8, +17] %"
std::string change_cell(const MetricVerdict& metric) {
  if (!std::isfinite(metric.change)) return "-";
  const double unit = unit_of_change(metric);
  const auto in_unit = [unit](double value) { return signed_number(value / unit); };
  return fmt::format("{} [{}, {}]{}", in_unit(metric.change), in_unit(metric.interval.low),
                     in_unit(metric.interval.high), unit == 1.0 ? "" : " %");
}

std::string margin_cell(const MetricVerdict& metric) {
  if (!std::isfinite(metric.margin)) return "-";
  const double unit = unit_of_change(metric);
  return fmt::format("{:.3g}{}", metric.margin / unit, unit == 1.0 ? "" : " %");
}

/// How many more seeds an inconclusive metric needs, for a column of its own.
std::string need_cell(const MetricVerdict& metric) {
  if (metric.verdict != Verdict::kInconclusive) return "";
  return metric.more_seeds ? fmt::format("{}", *metric.more_seeds) : "very many";
}

AlignedTable table_of(const ResultComparison& comparison, const VerdictSettings& settings, bool all) {
  AlignedTable table{.header = {"metric", "verdict", "A", "B",
                                fmt::format("worse by, {:g} % interval", 100.0 * (1.0 - settings.alpha)),
                                "margin", "p (Holm)", "seeds", "more seeds"}};
  for (const MetricVerdict& metric : comparison.metrics) {
    if (metric.verdict == Verdict::kPass && !all) continue;
    table.rows.push_back({metric.metric, text_of(metric.verdict), format_number(metric.first_mean),
                          format_number(metric.second_mean), metric.equal ? "equal" : change_cell(metric),
                          margin_cell(metric), metric.equal ? "-" : fmt::format("{:.2g}", metric.p_holm),
                          fmt::format("{}", metric.pairs), need_cell(metric)});
  }
  return table;
}

/// "1 seed", "2 seeds"
std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string conditions_line(const ResultComparison& comparison) {
  if (comparison.conditions.empty()) return "";
  return fmt::format("not judged, but different: {}\n", fmt::join(comparison.conditions, ", "));
}

}  // namespace

std::string verdict_summary(const ResultComparison& comparison) {
  std::string counts;
  for (const Verdict verdict : kVerdicts)
    if (const long count = count_of(comparison, verdict); count > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, text_of(verdict));
  return fmt::format("{} compared on {}: {}; {} of them changed\n",
                     counted(comparison.metrics.size(), "metric"), counted(comparison.seeds.size(), "seed"),
                     counts, comparison.changed);
}

std::string verdict_table(const ResultComparison& comparison, const VerdictSettings& settings, bool all) {
  const AlignedTable table = table_of(comparison, settings, all);
  return (table.rows.empty() ? std::string() : plain_text(table) + "\n") + conditions_line(comparison);
}

std::string verdict_page(const ResultComparison& comparison, const VerdictSettings& settings,
                         const ComparedNames& names) {
  std::string page =
      fmt::format("### {} (A) and {} (B)\n\n{}", names.first, names.second, verdict_summary(comparison));
  const AlignedTable table = table_of(comparison, settings, false);
  if (!table.rows.empty()) page += "\n" + markdown(table);
  const std::string conditions = conditions_line(comparison);
  return conditions.empty() ? page : page + "\n" + conditions;
}

Json verdict_json(const ResultComparison& comparison, const VerdictSettings& settings,
                  const ComparedNames& names) {
  Json metrics = Json::array();
  for (const MetricVerdict& metric : comparison.metrics)
    metrics.push_back({{"metric", metric.metric},
                       {"verdict", text_of(metric.verdict)},
                       {"pairs", metric.pairs},
                       {"equal", metric.equal},
                       {"first_mean", number(metric.first_mean)},
                       {"second_mean", number(metric.second_mean)},
                       {"worse_by", number(metric.change)},
                       {"low", number(metric.interval.low)},
                       {"high", number(metric.interval.high)},
                       {"margin", number(metric.margin)},
                       {"p", metric.p},
                       {"p_holm", metric.p_holm},
                       {"more_seeds", metric.more_seeds ? Json(*metric.more_seeds) : Json(nullptr)}});
  return {{"schema", 1},
          {"first", names.first},
          {"second", names.second},
          {"alpha", settings.alpha},
          {"seeds", comparison.seeds},
          {"changed", comparison.changed},
          {"metrics", metrics},
          {"conditions", comparison.conditions}};
}

}  // namespace stereobench::harness
