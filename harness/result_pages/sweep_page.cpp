#include "harness/result_pages/sweep_page.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/page/command_words.h"
#include "harness/response/response_page.h"
#include "harness/result_pages/filter_blocks.h"

namespace stereobench::harness {
namespace {

using SummaryOf = std::function<Summary(const SweepCell&)>;

/// The same in another unit.
Summary scaled_summary(Summary summary, double factor) {
  summary.mean *= factor;
  summary.half_width *= factor;
  return summary;
}

/// The cells that agree in all but the first variation, under the name of what they agree in.
std::vector<std::pair<std::string, std::vector<const SweepCell*>>> rows_of_cells(const SweepResult& sweep) {
  const std::vector<Variation> others(sweep.variations.begin() + 1, sweep.variations.end());
  std::vector<std::pair<std::string, std::vector<const SweepCell*>>> rows;
  for (const SweepCell& cell : sweep.cells) {
    const std::string name = name_of(others, Cell(cell.values.begin() + 1, cell.values.end()));
    auto row = std::ranges::find(rows, name, &decltype(rows)::value_type::first);
    if (row == rows.end()) row = rows.insert(rows.end(), {name, {}});
    row->second.push_back(&cell);
  }
  return rows;
}

Series series_of_cells(const std::string& name, const std::vector<const SweepCell*>& cells,
                       const SummaryOf& summary_of) {
  Series series{.name = name};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Summary summary = summary_of(*cells[i]);
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(summary.mean);
    series.low.push_back(summary.mean - summary.half_width);
    series.high.push_back(summary.mean + summary.half_width);
  }
  return series;
}

Chart chart_of_cells(const SweepResult& sweep, const std::vector<const SweepCell*>& cells,
                     const std::string& label, const std::string& where) {
  Chart chart{.name = where.empty() ? label : fmt::format("{} at {}", label, where),
              .x_label = sweep.variations.front().name(),
              .y_label = label,
              .y_is_logarithmic = true};
  for (const SweepCell* cell : cells) chart.x_names.push_back(cell->values.front());
  return chart;
}

std::vector<Chart> filter_charts(const SweepResult& sweep) {
  std::vector<Chart> charts;
  for (const auto& [where, cells] : rows_of_cells(sweep)) {
    Chart ate = chart_of_cells(sweep, cells, "ATE rms [m]", where);
    Chart anees = chart_of_cells(sweep, cells, "ANEES", where);
    const auto& filters = cells.front()->result.filters;
    for (std::size_t i = 0; i < filters.size(); ++i) {
      ate.series.push_back(series_of_cells(filters[i].filter, cells, [i](const SweepCell& cell) {
        return cell.result.filters[i].summary.ate_rms_m;
      }));
      anees.series.push_back(series_of_cells(filters[i].filter, cells, [i](const SweepCell& cell) {
        return cell.result.filters[i].summary.anees;
      }));
    }
    charts.insert(charts.end(), {std::move(ate), std::move(anees)});
  }
  return charts;
}

std::vector<Chart> vision_charts(const SweepResult& sweep) {
  std::vector<Chart> charts;
  for (const auto& [where, cells] : rows_of_cells(sweep)) {
    if (!cells.front()->result.vision) continue;
    Chart range = chart_of_cells(sweep, cells, "range error, rms [mm]", where);
    range.series = {series_of_cells(
        "rms", cells, [](const SweepCell& cell) { return scaled_summary(cell.range_rms_m, 1e3); })};
    Chart bearing = chart_of_cells(sweep, cells, "bearing error, rms [mrad]", where);
    bearing.series = {series_of_cells(
        "rms", cells, [](const SweepCell& cell) { return scaled_summary(cell.bearing_rms_rad, 1e3); })};
    charts.insert(charts.end(), {std::move(range), std::move(bearing)});
  }
  return charts;
}

/// A value of a variation; sorted by its number where it is one.
PageCell value_cell(const std::string& value) {
  PageCell cell{.text = value};
  std::istringstream stream(value);
  double number = 0.0;
  if (stream >> number && stream.eof()) cell.number = number;
  return cell;
}

Block cells_block(const SweepResult& sweep) {
  PageTable table;
  for (const Variation& variation : sweep.variations) table.header.push_back(variation.name());
  table.header.insert(table.header.end(), {"recall", "range rms [mm]", "bearing rms [mrad]"});
  for (const FilterResult& filter : sweep.cells.front().result.filters)
    table.header.push_back(filter.filter + " ATE [m]");
  for (const SweepCell& cell : sweep.cells) {
    PageRow row;
    for (const std::string& value : cell.values) row.cells.push_back(value_cell(value));
    row.cells.push_back(cell.result.vision ? number_cell(cell.result.vision->recall())
                                           : PageCell{.text = "-"});
    row.cells.push_back(summary_cell(scaled_summary(cell.range_rms_m, 1e3)));
    row.cells.push_back(summary_cell(scaled_summary(cell.bearing_rms_rad, 1e3)));
    for (const FilterResult& filter : cell.result.filters)
      row.cells.push_back(summary_cell(filter.summary.ate_rms_m));
    table.rows.push_back(std::move(row));
  }
  return {.title = "Cells", .note = kIntervalNote, .content = std::move(table)};
}

Block gate_lines_block(const std::string& gates) {
  PageText text;
  std::istringstream lines(gates);
  for (std::string line; std::getline(lines, line);) text.lines.push_back(line);
  if (text.lines.empty()) text.lines = {"No gate limits this result."};
  return {.title = "Gates", .note = "", .content = std::move(text)};
}

}  // namespace

Page sweep_page(const SweepResult& sweep, std::span<const std::string> words, const std::string& gates) {
  const auto& seeds = sweep.cells.front().result.seeds;
  Page page{.title = sweep.name + ": sweep",
            .facts = {fmt::format("{} cells", sweep.cells.size()),
                      fmt::format("seed{} {}", seeds.size() == 1 ? "" : "s", seeds_word(seeds)),
                      fmt::format("stereobench {}", STEREOBENCH_VERSION)}};
  page.blocks = {gate_lines_block(gates), cells_block(sweep)};
  const char* note = "Bars are 95 % intervals of the mean over seeds.";
  page.blocks.push_back({.title = "Errors of filters against " + sweep.variations.front().name(),
                         .note = note,
                         .content = PageCharts{filter_charts(sweep)}});
  if (std::vector<Chart> charts = vision_charts(sweep); !charts.empty())
    page.blocks.push_back({.title = "Errors of detections against " + sweep.variations.front().name(),
                           .note = note,
                           .content = PageCharts{std::move(charts)}});
  if (sweep.response)
    for (Block& block : response_blocks(*sweep.response)) page.blocks.push_back(std::move(block));
  if (words.empty()) return page;
  std::vector<std::string> line(words.begin(), words.end());
  line.insert(line.end(), {"--seeds", seeds_word(seeds)});
  for (Block& block : page.blocks) block.commands = {shell_line(line)};
  return page;
}

}  // namespace stereobench::harness
