#include "harness/result_pages/comparison_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/page/command_words.h"
#include "harness/result_pages/changed_frames.h"
#include "harness/result_pages/detection_charts.h"
#include "harness/result_pages/filter_blocks.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostMetrics = 30;

std::optional<PageInterval> interval_in_margins(const MetricVerdict& metric) {
  if (metric.equal || !std::isfinite(metric.change) || !(metric.margin > 0.0)) return {};
  return PageInterval{metric.interval.low / metric.margin, metric.change / metric.margin,
                      metric.interval.high / metric.margin};
}

/// @param has_regressed whether any metric has: then those that more seeds may decide are shown on demand
PageRow verdict_row(const MetricVerdict& metric, bool has_regressed) {
  const PageCell verdict{.text = text_of(metric.verdict),
                         .number = static_cast<double>(metric.verdict),
                         .mark = mark_of(metric.verdict)};
  PageCell change{.text = metric.equal ? "equal" : change_text(metric)};
  if (std::isfinite(metric.change)) change.number = metric.equal ? 0.0 : metric.change;
  PageCell drawn{.text = "", .interval = interval_in_margins(metric)};
  if (drawn.interval) drawn.number = drawn.interval->value;
  PageCell p{.text = "-"};
  if (metric.test != ChangeTest::kNone)
    p = {.text = fmt::format("{:.2g}", metric.p_holm), .number = metric.p_holm};
  return {{{.text = metric.metric},
           verdict,
           number_cell(metric.first_mean),
           number_cell(metric.second_mean),
           drawn,
           change,
           {.text = margin_text(metric), .number = metric.margin},
           p,
           count_cell(metric.pairs),
           {.text = note_text(metric)}},
          metric.verdict == Verdict::kPass || (has_regressed && metric.verdict == Verdict::kInconclusive)};
}

Block verdict_block(const ComparisonStory& story) {
  PageTable table{.header = {"metric", "verdict", "A", "B", "in margins",
                             fmt::format("worse by, {:g} % interval", 100.0 * (1.0 - story.settings.alpha)),
                             "margin", "p (Holm)", "seeds", "note"},
                  .quiet = "metrics that pass"};
  const bool has_regressed = story.comparison.has(Verdict::kRegressed);
  if (has_regressed && story.comparison.has(Verdict::kInconclusive))
    table.quiet = "metrics that pass or are inconclusive";
  for (const MetricVerdict& metric : story.comparison.metrics)
    table.rows.push_back(verdict_row(metric, has_regressed));
  return {.title = "Verdicts",
          .note = verdict_summary(story.comparison) + few_seeds_warning(story.comparison, story.settings) +
                  "In margins: drawn to the right is worse, and the grey zone is the margin.",
          .content = std::move(table)};
}

/// The values of a metric on the seeds that both results have.
std::vector<double> shared_values(const SeedTable& table, const std::string& metric,
                                  const std::vector<std::uint64_t>& seeds) {
  const auto found = table.metrics.find(metric);
  std::vector<double> values(seeds.size(), std::nan(""));
  if (found == table.metrics.end()) return values;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto place = std::ranges::find(table.seeds, seeds[i]) - table.seeds.begin();
    if (static_cast<std::size_t>(place) < found->second.size())
      values[i] = found->second[static_cast<std::size_t>(place)];
  }
  return values;
}

/// Axes of a chart over the seeds, by their places.
Chart chart_over_seeds(const std::vector<std::uint64_t>& seeds, const std::string& name,
                       const std::string& label) {
  constexpr std::size_t kMostNamed = 60;
  Chart chart{.name = name, .x_label = "seed", .y_label = label};
  if (seeds.size() <= kMostNamed)
    for (const std::uint64_t seed : seeds) chart.x_names.push_back(fmt::format("{}", seed));
  return chart;
}

std::vector<Chart> paired_charts(const ComparisonStory& story, const std::string& metric) {
  const std::vector<std::uint64_t>& seeds = story.comparison.seeds;
  const std::vector<double> first = shared_values(story.first.seeds, metric, seeds);
  const std::vector<double> second = shared_values(story.second.seeds, metric, seeds);
  std::vector<double> place, change;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    place.push_back(static_cast<double>(i));
    change.push_back(second[i] - first[i]);
  }
  const Summary mean = summarise(change);
  const std::vector<double> ends = {-0.5, static_cast<double>(seeds.size()) - 0.5};
  const auto over_all = [&](double value) { return std::vector<double>(2, value); };
  Chart changes = chart_over_seeds(seeds, metric + ": B minus A", metric + ", B minus A");
  changes.series = {{.name = "B minus A", .look = Look::kPoints, .x = place, .y = change},
                    {.name = "no change", .look = Look::kDashes, .x = ends, .y = over_all(0.0)},
                    {.name = "mean", .x = ends, .y = over_all(mean.mean)},
                    {.name = "mean, 95 % interval",
                     .look = Look::kBand,
                     .x = ends,
                     .low = over_all(mean.mean - mean.half_width),
                     .high = over_all(mean.mean + mean.half_width)}};
  Chart values = chart_over_seeds(seeds, metric + ": A and B", metric);
  values.series = {{.name = "A", .look = Look::kPoints, .x = place, .y = first},
                   {.name = "B", .look = Look::kPoints, .x = place, .y = second}};
  return {std::move(changes), std::move(values)};
}

/// Charts of the metrics that changed, in the order of their verdicts.
std::vector<Block> paired_blocks(const ComparisonStory& story) {
  PageCharts block;
  std::size_t metrics = 0;
  for (const MetricVerdict& metric : story.comparison.metrics) {
    if (metric.equal || metric.pairs == 0 || ++metrics > kMostMetrics) continue;
    std::ranges::move(paired_charts(story, metric.metric), std::back_inserter(block.charts));
  }
  if (block.charts.empty()) return {};
  const std::string left_out =
      metrics > kMostMetrics
          ? fmt::format(" The first {} of the {} metrics that changed.", kMostMetrics, metrics)
          : "";
  return {
      {.title = "Changes seed by seed",
       .note = "Each point is one seed in both results. The interval of the mean is Student's t; verdicts "
               "rest on the one in the table." +
               left_out,
       .content = std::move(block)}};
}

PageRow slice_row(const char* what, const Slice& slice) {
  const auto count = [](std::size_t number) { return count_cell(static_cast<long>(number)); };
  const std::string where = slice.conditions.empty() ? "nothing in common that chance does not explain"
                                                     : fmt::format("{}", fmt::join(slice.conditions, ", "));
  return {{{.text = what},
           {.text = where},
           count(slice.marked),
           count(slice.all_marked),
           count(slice.things),
           count(slice.all_things)}};
}

std::vector<Block> slice_blocks(const ComparisonStory& story) {
  if (!story.changes) return {};
  const DetectionChanges& changes = *story.changes;
  PageTable table{
      .header = {"balls that", "have in common", "of them there", "of them", "balls there", "balls"}};
  if (changes.lost_slice) table.rows.push_back(slice_row("B alone lost", *changes.lost_slice));
  if (changes.misidentified_slice)
    table.rows.push_back(slice_row("B alone took for another colour", *changes.misidentified_slice));
  if (changes.misplaced_slice)
    table.rows.push_back(
        slice_row("carry nine tenths of the growth of range errors", *changes.misplaced_slice));
  PageText text;
  std::istringstream lines(changes_text(changes, true));
  for (std::string line; std::getline(lines, line);) text.lines.push_back(line);
  if (text.lines.empty()) text.lines = {"No detection changed."};
  std::vector<Block> blocks = {{.title = "Detections", .note = "", .content = std::move(text)}};
  if (!table.rows.empty())
    blocks.push_back(
        {.title = "What changed detections have in common", .note = "", .content = std::move(table)});
  return blocks;
}

std::vector<Block> other_blocks(const ComparisonStory& story) {
  const std::vector<std::string>& metrics = story.comparison.not_judged;
  if (metrics.empty()) return {};
  return {{.title = "Not judged, but different",
           .note = "No rule calls these numbers better or worse.",
           .content = PageText{metrics}}};
}

void append_blocks(std::vector<Block>& blocks, std::vector<Block> more) {
  std::ranges::move(more, std::back_inserter(blocks));
}

std::vector<Block> table_blocks(const ComparisonStory& story) {
  if (!story.changes) return {};
  const std::vector<DetectionRow> second = read_detection_rows(story.second.detections);
  const std::vector<DetectionRow> first = story.findings ? rows_of_findings(*story.findings, second)
                                                         : read_detection_rows(story.first.detections);
  std::vector<Block> blocks;
  const NamedDetections sets[] = {{"A", first}, {"B", second}};
  if (std::vector<Chart> charts = detection_charts(sets); !charts.empty())
    blocks.push_back({.title = "Detections against range and noise",
                      .note = "Of right detections; bars are 95 % intervals of the rms.",
                      .content = PageCharts{std::move(charts)}});
  PageFrames frames = changed_frames({story.first.detections.parent_path(), first},
                                     {story.second.detections.parent_path(), second}, story.changes->frames);
  if (!frames.frames.empty())
    blocks.push_back({.title = "The frames that changed most",
                      .note =
                          "A to the left, B to the right. Outlines are the truth: green found, red missed, "
                          "orange taken for another colour, dashed did not have to be found. Crosses are "
                          "detections, with their range error.",
                      .content = std::move(frames)});
  return blocks;
}

}  // namespace

CellMark mark_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kRegressed:
    case Verdict::kVanished:
      return CellMark::kBad;
    case Verdict::kInconclusive:
      return CellMark::kUnsure;
    case Verdict::kImproved:
    case Verdict::kPass:
      return CellMark::kGood;
    case Verdict::kNew:
      break;
  }
  return CellMark::kNone;
}

std::vector<Block> comparison_blocks(const ComparisonStory& story) {
  std::vector<Block> blocks = {verdict_block(story)};
  append_blocks(blocks, slice_blocks(story));
  append_blocks(blocks, paired_blocks(story));
  append_blocks(blocks, table_blocks(story));
  append_blocks(blocks, other_blocks(story));
  if (!story.words.empty())
    for (Block& block : blocks) block.commands = {shell_line(story.words)};
  return blocks;
}

Page comparison_page(const ComparisonStory& story) {
  const auto fact = [](const char* which, const std::string& name, const StoredResult& result) {
    return fmt::format("{}: {} ({}, {} seeds)", which, name, result.scenario, result.seeds.seeds.size());
  };
  Page page{.title = story.second.scenario + ": what changed",
            .facts = {fact("A", story.names.first, story.first), fact("B", story.names.second, story.second)},
            .blocks = comparison_blocks(story)};
  if (story.first.scenario != story.second.scenario)
    page.facts.push_back("warning: A and B are of different scenarios");
  return page;
}

Page cases_page(const std::string& title, const std::vector<std::string>& facts,
                std::vector<ComparedCase> cases) {
  Page page{.title = title, .facts = facts};
  PageTable table{.header = {"case", "verdict", "says"}};
  const bool has_reasons = std::ranges::any_of(cases, [](const auto& one) { return !one.reason.empty(); });
  if (has_reasons) table.header.push_back("which balls");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    PageRow row{{{.text = cases[i].name, .link = fmt::format("case-{}", i + 1)},
                 {.text = cases[i].verdict, .mark = cases[i].mark},
                 {.text = cases[i].says}}};
    if (has_reasons) row.cells.push_back({.text = cases[i].reason});
    table.rows.push_back(std::move(row));
  }
  page.blocks.push_back({.title = "Cases", .note = "", .content = std::move(table)});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    page.blocks.push_back({.title = cases[i].name,
                           .note = cases[i].blocks.size() > 1 ? "" : cases[i].says,
                           .identity = fmt::format("case-{}", i + 1),
                           .is_chapter = true});
    append_blocks(page.blocks, std::move(cases[i].blocks));
  }
  return page;
}

}  // namespace stereobench::harness
