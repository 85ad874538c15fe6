#include "harness/sweep/sweep_result.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"
#include "harness/report/sweep_picture.h"
#include "harness/response/response_picture.h"
#include "harness/response/response_table.h"

namespace stereobench::harness {
namespace {

MeanInterval scaled(const Summary& summary, double scale) {
  return {scale * summary.mean, scale * (summary.mean - summary.half_width),
          scale * (summary.mean + summary.half_width)};
}

std::string with_interval(const Summary& summary, double scale) {
  return format_interval(scale * summary.mean, scale * summary.half_width);
}

/// A cell of a CSV; empty for what has no value.
std::string csv_cell(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

/// A list's commas are none of the file's.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// ",difference,half width,p", and the line's end.
std::string csv_difference(const PairedDifference& pair) {
  const double p = pair.difference.count < 2 ? std::nan("") : pair.p_value;
  return fmt::format(",{},{},{}\n", csv_cell(pair.difference.mean), csv_cell(pair.difference.half_width),
                     csv_cell(p));
}

/// How much one filter is worse than another, and whether that may be chance.
std::string with_p_value(const PairedDifference& pair) {
  if (pair.difference.count < 2) return "-";
  return fmt::format("{} (p {})", with_interval(pair.difference, 1.0), format_number(pair.p_value, 2));
}

/// The cells that differ in the first variation only, one group for each combination of the others.
std::vector<std::vector<const SweepCell*>> groups_of(const SweepResult& sweep) {
  const std::size_t groups = sweep.cells.size() / sweep.variations.front().values.size();
  std::vector<std::vector<const SweepCell*>> grouped(groups);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) grouped[i % groups].push_back(&sweep.cells[i]);
  return grouped;
}

std::string title_of(const SweepResult& sweep, const SweepCell& cell) {
  std::string title = fmt::format("{}, {} seeds", sweep.name, cell.result.seeds.size());
  for (std::size_t i = 1; i < sweep.variations.size(); ++i)
    title += fmt::format(", {} = {}", sweep.variations[i].name(), cell.values[i]);
  return title;
}

std::string picture_of(const SweepResult& sweep, const std::vector<const SweepCell*>& cells) {
  SweepPicture picture{.title = title_of(sweep, *cells.front()),
                       .parameter = sweep.variations.front().name()};
  SweepCurve range{.name = "range rms [mm]", .values = {}};
  SweepCurve bearing{.name = "bearing rms [mrad]", .values = {}};
  for (const FilterResult& filter : cells.front()->result.filters)
    picture.ate_m.push_back({filter.filter, {}});
  for (const SweepCell* cell : cells) {
    picture.values.push_back(cell->values.front());
    range.values.push_back(scaled(cell->range_rms_m, 1e3));
    bearing.values.push_back(scaled(cell->bearing_rms_rad, 1e3));
    for (std::size_t i = 0; i < picture.ate_m.size(); ++i)
      picture.ate_m[i].values.push_back(scaled(cell->result.filters[i].summary.ate_rms_m, 1.0));
  }
  if (cells.front()->result.vision) picture.detection = {range, bearing};
  return draw_sweep_picture(picture);
}

}  // namespace

void CellTally::add(const SeedResult& seed) {
  run_.add(seed);
  ate_m_.resize(seed.runs.size());
  for (std::size_t i = 0; i < seed.runs.size(); ++i)
    ate_m_[i].push_back(seed.runs[i].score.trajectory.ate_rms_m);
  if (seed.bound) bound_m_.push_back(seed.bound->filtering.pose_rms_m);
  if (!seed.vision) return;
  range_rms_m_.push_back(seed.vision->range_rms_m());
  bearing_rms_rad_.push_back(seed.vision->bearing_rms_rad());
}

SweepCell CellTally::cell(Cell values) const {
  return {std::move(values),           run_.result(), summarise(range_rms_m_),
          summarise(bearing_rms_rad_), ate_m_,        bound_m_};
}

std::vector<CellDifference> differences_of(const SweepResult& sweep, const SweepCell& cell) {
  if (!sweep.paired_to) return {};
  Cell wanted = cell.values;
  wanted.front() = *sweep.paired_to;
  const auto reference = std::ranges::find(sweep.cells, wanted, &SweepCell::values);
  std::vector<CellDifference> differences;
  for (std::size_t i = 0; i < cell.ate_m.size(); ++i)
    differences.push_back(
        {cell.result.filters[i].filter, compare_paired(cell.ate_m[i], reference->ate_m[i])});
  return differences;
}

std::string sweep_table(const SweepResult& sweep) {
  AlignedTable table;
  for (const Variation& variation : sweep.variations) table.header.push_back(variation.name());
  table.header.insert(table.header.end(), {"recall", "range rms [mm] +- 95 %", "bearing rms [mrad] +- 95 %"});
  for (const FilterResult& filter : sweep.cells.front().result.filters)
    table.header.push_back(filter.filter + " ATE [m] +- 95 %");
  for (const Comparison& comparison : sweep.cells.front().result.comparisons)
    table.header.push_back(fmt::format("{} - {} [m] +- 95 %", comparison.filter, comparison.other));
  for (const CellDifference& difference : differences_of(sweep, sweep.cells.front()))
    table.header.push_back(fmt::format("{} - at {} [m] +- 95 %", difference.filter, *sweep.paired_to));
  for (const SweepCell& cell : sweep.cells) {
    std::vector<std::string> row = cell.values;
    row.push_back(cell.result.vision ? format_number(cell.result.vision->recall()) : "-");
    row.push_back(with_interval(cell.range_rms_m, 1e3));
    row.push_back(with_interval(cell.bearing_rms_rad, 1e3));
    for (const FilterResult& filter : cell.result.filters)
      row.push_back(with_interval(filter.summary.ate_rms_m, 1.0));
    for (const Comparison& comparison : cell.result.comparisons)
      row.push_back(with_p_value(comparison.ate_m));
    for (const CellDifference& difference : differences_of(sweep, cell))
      row.push_back(with_p_value(difference.ate_m));
    table.rows.push_back(std::move(row));
  }
  return plain_text(table) + (sweep.response ? "\n" + response_table(*sweep.response) : std::string());
}

std::string sweep_csv(const SweepResult& sweep) {
  std::string csv;
  for (const Variation& variation : sweep.variations)
    for (const std::string& key : variation.keys) csv += key + ",";
  csv += "filter,seeds,ate_rms_m,ate_ci95_m,landmark_rms_m,failures,recall,range_rms_m,bearing_rms_rad";
  csv += sweep.paired_to ? ",ate_difference_m,ate_difference_ci95_m,p\n" : "\n";
  for (const SweepCell& cell : sweep.cells) {
    const std::vector<CellDifference> differences = differences_of(sweep, cell);
    for (std::size_t i = 0; i < cell.result.filters.size(); ++i) {
      const FilterResult& filter = cell.result.filters[i];
      const FilterSummary& s = filter.summary;
      for (const Setting& setting : settings_of(sweep.variations, cell.values))
        csv += csv_cell(setting.value) + ",";
      csv += fmt::format("{},{},{},{},{},{}", filter.filter, cell.result.seeds.size(),
                         csv_cell(s.ate_rms_m.mean), csv_cell(s.ate_rms_m.half_width),
                         csv_cell(s.landmark_rms_m.mean), s.failures);
      const double recall = cell.result.vision ? cell.result.vision->recall() : std::nan("");
      csv += fmt::format(",{},{},{}", csv_cell(recall), csv_cell(cell.range_rms_m.mean),
                         csv_cell(cell.bearing_rms_rad.mean));
      csv += differences.empty() ? "\n" : csv_difference(differences[i].ate_m);
    }
  }
  return csv;
}

nlohmann::ordered_json sweep_json(const SweepResult& sweep) {
  nlohmann::ordered_json cells = nlohmann::ordered_json::array();
  for (const SweepCell& cell : sweep.cells) {
    nlohmann::ordered_json values;
    for (const Setting& setting : settings_of(sweep.variations, cell.values))
      values[setting.key] = setting.value;
    cells.push_back({{"values", std::move(values)}, {"run", run_json(cell.result)}});
    for (const CellDifference& difference : differences_of(sweep, cell))
      cells.back()["differences"].push_back({{"filter", difference.filter},
                                             {"ate_m", summary_json(difference.ate_m.difference)},
                                             {"p", difference.ate_m.p_value}});
  }
  nlohmann::ordered_json json = {{"schema", 1}, {"scenario", sweep.name}, {"cells", std::move(cells)}};
  if (sweep.paired_to) json["paired_to"] = *sweep.paired_to;
  if (sweep.response) json["response"] = response_json(*sweep.response);
  return json;
}

std::vector<NamedPicture> sweep_pictures(const SweepResult& sweep) {
  std::vector<NamedPicture> pictures;
  const auto groups = groups_of(sweep);
  for (std::size_t i = 0; i < groups.size(); ++i)
    pictures.push_back({groups.size() == 1 ? "sweep.png" : fmt::format("sweep_{:02}.png", i + 1),
                        picture_of(sweep, groups[i])});
  if (sweep.response)
    pictures.push_back({"response.png", draw_response_picture(*sweep.response, sweep.name)});
  return pictures;
}

}  // namespace stereobench::harness
