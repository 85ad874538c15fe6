#include "harness/attribution/attribution_page.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/page/command_words.h"
#include "harness/result_pages/filter_blocks.h"

namespace stereobench::harness {
namespace {

std::vector<std::string> metrics_of(const Attribution& attribution) {
  std::vector<std::string> names;
  for (const AttributedMetric& metric : attribution.metrics)
    if (std::ranges::find(names, metric.metric) == names.end()) names.push_back(metric.metric);
  return names;
}

std::string with_unit(const AttributedMetric& metric) {
  return metric.unit.empty() ? metric.metric : fmt::format("{} [{}]", metric.metric, metric.unit);
}

Series shares_of(const AttributedMetric& metric) {
  Series series{.name = metric.filter, .look = Look::kPoints};
  for (const PartSummary& part : metric.parts) {
    series.x.push_back(static_cast<double>(series.x.size()));
    series.y.push_back(part.share.mean);
    series.low.push_back(part.share.mean - part.share.half_width);
    series.high.push_back(part.share.mean + part.share.half_width);
  }
  return series;
}

Block shares_block(const Attribution& attribution) {
  PageCharts charts;
  for (const std::string& name : metrics_of(attribution)) {
    Chart chart{.name = name, .x_label = "part of the chain", .y_label = "share"};
    for (const Oracle& part : attribution.parts) chart.x_names.push_back(part.part);
    for (const AttributedMetric& metric : attribution.metrics) {
      if (metric.metric != name) continue;
      chart.y_label = "share of " + with_unit(metric);
      chart.series.push_back(shares_of(metric));
    }
    charts.charts.push_back(std::move(chart));
  }
  return {.title = "Shares",
          .note =
              "What goes when a part becomes perfect, on average over all orders (Shapley). The shares of "
              "a filter add up to what goes when all are perfect. Bars are 95 % intervals over seeds.",
          .content = std::move(charts)};
}

Block table_block(const AttributedMetric& metric) {
  PageTable table{.header = {"part", "share", "gone if it alone is perfect", "left if it alone is real"}};
  for (const PartSummary& part : metric.parts)
    table.rows.push_back({{{.text = part.part},
                           summary_cell(part.share),
                           summary_cell(part.only_perfect),
                           summary_cell(part.only_real)}});
  return {.title = fmt::format("{}: {}", metric.filter, with_unit(metric)),
          .note = fmt::format("{} as it is, {} with all parts perfect. {} seeds left out. {}",
                              format_interval(metric.real.mean, metric.real.half_width),
                              format_interval(metric.perfect.mean, metric.perfect.half_width),
                              metric.seeds_left_out, kIntervalNote),
          .content = std::move(table)};
}

Block parts_block(const Attribution& attribution) {
  PageTable table{.header = {"part", "when it is perfect", "lines of the scenario"}};
  for (const Oracle& part : attribution.parts) {
    std::string lines;
    for (const std::string& line : part.set) lines += (lines.empty() ? "" : "; ") + line;
    table.rows.push_back({{{.text = part.part}, {.text = part.says}, {.text = lines.empty() ? "-" : lines}}});
  }
  return {
      .title = "Parts", .note = "Each combination was run on the same seeds.", .content = std::move(table)};
}

}  // namespace

Page attribution_page(const Attribution& attribution, std::span<const std::string> words) {
  Page page{.title = attribution.scenario + ": whose the error is",
            .facts = {fmt::format("seed{} {}", attribution.seeds.size() == 1 ? "" : "s",
                                  seeds_word(attribution.seeds)),
                      fmt::format("stereobench {}", STEREOBENCH_VERSION)},
            .blocks = {shares_block(attribution)}};
  for (const AttributedMetric& metric : attribution.metrics) page.blocks.push_back(table_block(metric));
  page.blocks.push_back(parts_block(attribution));
  if (words.empty()) return page;
  std::vector<std::string> line(words.begin(), words.end());
  line.insert(line.end(), {"--seeds", seeds_word(attribution.seeds)});
  for (Block& block : page.blocks) block.commands = {shell_line(line)};
  return page;
}

}  // namespace stereobench::harness
