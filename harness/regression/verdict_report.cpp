#include "harness/regression/verdict_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// A table for people has so many rows of metrics that more seeds may decide, and names so many that are not
/// judged.
constexpr long kMostInconclusive = 10;
constexpr long kMostBesideRegressed = 3;  ///< of them where a metric is REGRESSED
constexpr std::size_t kMostNotJudged = 5;

constexpr std::array kVerdicts = {Verdict::kRegressed, Verdict::kVanished, Verdict::kInconclusive,
                                  Verdict::kImproved,  Verdict::kNew,      Verdict::kPass};

long count_of(const ResultComparison& comparison, Verdict verdict) {
  return std::ranges::count(comparison.metrics, verdict, &MetricVerdict::verdict);
}

/// What a change is said in: hundredths of what a relative margin is a share of, else its own unit.
double unit_of_change(const MetricVerdict& metric) {
  return metric.scale > 0.0 ? 0.01 * metric.scale : 1.0;
}

/// What a change is said in, behind its number.
const char* unit_text(const MetricVerdict& metric) {
  if (metric.scale > 0.0) return scale_of(metric.metric) == metric.metric ? " %" : " % of the rms";
  const std::optional<MetricRule> rule = rule_of(metric.metric);
  return rule && rule->better == MetricRule::Better::kNearOne ? " (ln)" : "";
}

const char* text_of(ChangeTest test) {
  switch (test) {
    case ChangeTest::kWilcoxon:
      return "wilcoxon";
    case ChangeTest::kMcnemar:
      return "mcnemar";
    case ChangeTest::kExact:
      return "exact";
    case ChangeTest::kNone:
      break;
  }
  return "none";
}

std::string signed_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "-" : value < 0.0 ? "-inf" : "inf";
  return (value < 0.0 ? "-" : "+") + format_number(std::abs(value));
}

/// "1 seed", "2 seeds"
std::string counted(long count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

long most_inconclusive(const ResultComparison& comparison) {
  return comparison.has(Verdict::kRegressed) ? kMostBesideRegressed : kMostInconclusive;
}

AlignedTable table_of(const ResultComparison& comparison, const VerdictSettings& settings, bool all) {
  AlignedTable table{.header = {"metric", "verdict", "A", "B",
                                fmt::format("worse by, {:g} % interval", 100.0 * (1.0 - settings.alpha)),
                                "margin", "p (Holm)", "seeds", "note"}};
  long inconclusive = 0;
  for (const MetricVerdict& metric : comparison.metrics) {
    if (metric.verdict == Verdict::kPass && !all) continue;
    if (metric.verdict == Verdict::kInconclusive && ++inconclusive > most_inconclusive(comparison) && !all)
      continue;
    table.rows.push_back({metric.metric, text_of(metric.verdict), format_number(metric.first_mean),
                          format_number(metric.second_mean), metric.equal ? "equal" : change_text(metric),
                          margin_text(metric),
                          metric.test == ChangeTest::kNone ? "-" : fmt::format("{:.2g}", metric.p_holm),
                          fmt::format("{}", metric.pairs), note_text(metric)});
  }
  return table;
}

/// What the table leaves out.
std::string lines_below(const ResultComparison& comparison, bool all) {
  std::string lines;
  const long left_out = count_of(comparison, Verdict::kInconclusive) - most_inconclusive(comparison);
  if (!all && left_out > 0) lines += counted(left_out, "more metric") + " INCONCLUSIVE\n";
  const std::vector<std::string>& names = comparison.not_judged;
  if (names.empty()) return lines;
  const std::size_t shown = all ? names.size() : std::min(names.size(), kMostNotJudged);
  const std::vector<std::string> first(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown));
  lines += fmt::format("not judged, but different: {}{}\n", fmt::join(first, ", "),
                       shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
  return lines;
}

}  // namespace

std::string change_text(const MetricVerdict& metric) {
  if (!std::isfinite(metric.change)) return "-";
  const double unit = unit_of_change(metric);
  const double rounding = 1e-12 * std::max(std::abs(metric.first_mean), std::abs(metric.second_mean));
  const auto in_unit = [&](double value) {
    return signed_number(std::abs(value) < rounding ? 0.0 : value / unit);
  };
  return fmt::format("{} [{}, {}]{}", in_unit(metric.change), in_unit(metric.interval.low),
                     in_unit(metric.interval.high), unit_text(metric));
}

std::string margin_text(const MetricVerdict& metric) {
  if (!std::isfinite(metric.margin)) return "-";
  const double unit = unit_of_change(metric);
  return fmt::format("{:.3g}{}", metric.margin / unit, unit_text(metric));
}

std::string note_text(const MetricVerdict& metric) {
  if (metric.verdict == Verdict::kVanished)
    return fmt::format("no value on {}", counted(metric.lost, "seed"));
  if (metric.test == ChangeTest::kExact) return "no chance in it";
  if (metric.verdict != Verdict::kInconclusive) return "";
  return metric.more_seeds ? "about " + counted(*metric.more_seeds, "more seed") : "";
}

std::string change_line(const MetricVerdict& metric) {
  const std::string means =
      fmt::format("{} in A, {} in B", format_number(metric.first_mean), format_number(metric.second_mean));
  if (metric.equal) return means + ", equal on every seed";
  const std::string note = note_text(metric);
  return fmt::format("{}; worse by {}, margin {}, p {:.2g} on {}{}", means, change_text(metric),
                     margin_text(metric), metric.p_holm, counted(metric.pairs, "seed"),
                     note.empty() ? "" : "; " + note);
}

std::string verdict_summary(const ResultComparison& comparison) {
  std::string counts;
  for (const Verdict verdict : kVerdicts)
    if (const long count = count_of(comparison, verdict); count > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, text_of(verdict));
  return fmt::format("{} compared on {}: {}; {} of them changed\n",
                     counted(std::ssize(comparison.metrics), "metric"),
                     counted(std::ssize(comparison.seeds), "seed"), counts, comparison.changed);
}

std::string verdict_table(const ResultComparison& comparison, const VerdictSettings& settings, bool all) {
  const AlignedTable table = table_of(comparison, settings, all);
  return (table.rows.empty() ? std::string() : plain_text(table) + "\n") + lines_below(comparison, all);
}

std::string few_seeds_warning(const ResultComparison& comparison, const VerdictSettings& settings) {
  const long seeds = std::ssize(comparison.seeds);
  if (comparison.changed == 0 || seeds >= comparison.fewest_seeds) return "";
  return fmt::format("warning: {} cannot tell {} from chance (alpha {:g}): {} are the fewest that can\n",
                     counted(seeds, "seed"), counted(comparison.changed, "changed metric"), settings.alpha,
                     comparison.fewest_seeds);
}

std::string verdict_page(const ResultComparison& comparison, const VerdictSettings& settings,
                         const ComparedNames& names, const std::string& detections, bool all) {
  std::string page =
      fmt::format("### {} (A) and {} (B)\n\n{}", names.first, names.second, verdict_summary(comparison));
  const AlignedTable table = table_of(comparison, settings, all);
  if (!table.rows.empty()) page += "\n" + markdown(table);
  if (!detections.empty()) page += "\n```text\n" + detections + "```\n";
  const std::string below = lines_below(comparison, all);
  return below.empty() ? page : page + "\n" + below;
}

Json verdict_json(const ResultComparison& comparison, const VerdictSettings& settings,
                  const ComparedNames& names) {
  Json metrics = Json::array();
  for (const MetricVerdict& metric : comparison.metrics)
    metrics.push_back({{"metric", metric.metric},
                       {"verdict", text_of(metric.verdict)},
                       {"pairs", metric.pairs},
                       {"lost", metric.lost},
                       {"equal", metric.equal},
                       {"first_mean", number(metric.first_mean)},
                       {"second_mean", number(metric.second_mean)},
                       {"worse_by", number(metric.change)},
                       {"low", number(metric.interval.low)},
                       {"high", number(metric.interval.high)},
                       {"margin", number(metric.margin)},
                       {"test", text_of(metric.test)},
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
          {"not_judged", comparison.not_judged}};
}

}  // namespace stereobench::harness
