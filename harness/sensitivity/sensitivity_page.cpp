#include "harness/sensitivity/sensitivity_page.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/page/command_words.h"
#include "harness/sensitivity/sensitivity_report.h"

namespace stereobench::harness {
namespace {

PageCell share_cell(double share) {
  if (!std::isfinite(share)) return {.text = "-"};
  return {.text = fmt::format("{:.3f}", share), .number = share};
}

std::vector<PageCell> index_cells(const IndexEstimate& index) {
  return {share_cell(index.value), share_cell(index.interval.low), share_cell(index.interval.high)};
}

PageTable table_of_indices(const Sensitivity& study) {
  PageTable table{.header = {"factor", "values", "first", "first, from", "first, to", "total", "total, from",
                             "total, to"},
                  .rows = {}};
  for (const std::size_t factor : order_by_total(study.indices)) {
    const FactorIndices& indices = study.indices.factors[factor];
    PageRow row{.cells = {{.text = study.factors.name(factor)}, {.text = study.factors.values(factor)}}};
    for (const IndexEstimate& index : {indices.first, indices.total})
      for (PageCell& cell : index_cells(index)) row.cells.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// @param shift along the axis, so that two series do not hide each other
Series series_of_indices(const Sensitivity& study, const std::string& name,
                         IndexEstimate FactorIndices::*kind, double shift) {
  Series series{.name = name, .look = Look::kPoints, .x = {}, .y = {}, .low = {}, .high = {}};
  for (const std::size_t factor : order_by_total(study.indices)) {
    const IndexEstimate& index = study.indices.factors[factor].*kind;
    series.x.push_back(static_cast<double>(series.x.size()) + shift);
    series.y.push_back(index.value);
    series.low.push_back(index.interval.low);
    series.high.push_back(index.interval.high);
  }
  return series;
}

Chart chart_of_indices(const Sensitivity& study) {
  Chart chart{.name = "indices", .x_label = "factor", .y_label = "share of the variance of " + study.metric};
  for (const std::size_t factor : order_by_total(study.indices))
    chart.x_names.push_back(study.factors.name(factor));
  chart.series = {series_of_indices(study, "first", &FactorIndices::first, -0.06),
                  series_of_indices(study, "total", &FactorIndices::total, 0.06)};
  return chart;
}

}  // namespace

std::vector<Block> sensitivity_blocks(const Sensitivity& study, std::span<const std::string> words) {
  const std::string title = "What matters to " + study.metric;
  std::vector<Block> blocks = {
      {.title = title, .note = "", .content = PageText{sensitivity_remarks(study)}},
      {.title = "Sobol' indices",
       .note = fmt::format("Shares of the variance, with {:g} % intervals.", 100.0 * study.settings.level),
       .content = table_of_indices(study)},
      {.title = "Sobol' indices, drawn",
       .note = "First: this factor alone. Total: with its interactions. Bars are intervals.",
       .content = PageCharts{{chart_of_indices(study)}}}};
  if (words.empty()) return blocks;
  for (Block& block : blocks) block.commands = {shell_line(words)};
  return blocks;
}

Page sensitivity_page(const Sensitivity& study, std::span<const std::string> words) {
  return {.title = study.scenario + ": sensitivity",
          .facts = {fmt::format("{} runs", count_of_points(study.factors, study.settings.samples)),
                    fmt::format("seed {}", study.settings.seed),
                    fmt::format("stereobench {}", STEREOBENCH_VERSION)},
          .blocks = sensitivity_blocks(study, words)};
}

}  // namespace stereobench::harness
