#include "harness/result_pages/calibration_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/page/command_words.h"
#include "harness/result_pages/filter_blocks.h"
#include "harness/result_pages/gates_block.h"

namespace stereobench::harness {
namespace {

constexpr double kThousand = 1e3;  // millimetres in a metre, milliradians in a radian

PageCell depth_cell(const CalibrationBin& bin) {
  if (!bin.whole) return {.text = "parts of balls"};
  return {.text = fmt::format("{:.2f} .. {:.2f}", bin.nearest_m, bin.farthest_m), .number = bin.nearest_m};
}

Block bins_block(const std::vector<CalibrationBin>& bins) {
  PageTable table{.header = {"depth [m]", "balls", "refused", "range bias [mm]", "range sd [mm]",
                             "range sd / bound", "bearing bias [mrad]", "bearing sd [mrad]",
                             "bearing sd / bound", "NIS/2 stated", "NIS/2 per observation", "NIS/2 stereo"}};
  for (const CalibrationBin& bin : bins)
    table.rows.push_back(
        {{depth_cell(bin), count_cell(bin.samples), count_cell(bin.refused),
          number_cell(kThousand * bin.bias.x()), number_cell(kThousand * bin.sd.x()),
          number_cell(bin.over_bound.x()), number_cell(kThousand * bin.bias.y()),
          number_cell(kThousand * bin.sd.y()), number_cell(bin.over_bound.y()), number_cell(bin.half_nis[0]),
          number_cell(bin.half_nis[1]), number_cell(bin.half_nis[2])}});
  return {.title = "Errors by depth",
          .note =
              "Of the half of the scenes that is held out. The bound is that of Cramer and Rao. NIS/2 is 1 "
              "where covariances are consistent.",
          .content = std::move(table)};
}

/// Numbers of bins of whole balls over their depth, by the geometric mean of its ends.
template <class ValueOf>
Series over_depth(const std::string& name, const std::vector<CalibrationBin>& bins, const ValueOf& value_of) {
  Series series{.name = name};
  for (const CalibrationBin& bin : bins) {
    if (!bin.whole || bin.samples == 0) continue;
    series.x.push_back(std::sqrt(bin.nearest_m * bin.farthest_m));
    series.y.push_back(value_of(bin));
  }
  return series;
}

Chart depth_chart(const std::string& name, const std::string& label, std::vector<Series> series) {
  return {.name = name,
          .x_label = "depth [m]",
          .y_label = label,
          .x_is_logarithmic = true,
          .y_is_logarithmic = true,
          .series = std::move(series)};
}

std::vector<Chart> charts_over_depth(const std::vector<CalibrationBin>& bins) {
  const auto sd_and_bound = [&](int coordinate) {
    return std::vector<Series>{
        over_depth("sd", bins, [=](const CalibrationBin& bin) { return kThousand * bin.sd[coordinate]; }),
        over_depth("bound", bins, [=](const CalibrationBin& bin) {
          return kThousand * bin.sd[coordinate] / bin.over_bound[coordinate];
        })};
  };
  std::vector<Series> consistency;
  const char* kinds[] = {"as stated", "per observation", "stereo law"};
  for (int kind = 0; kind < 3; ++kind)
    consistency.push_back(
        over_depth(kinds[kind], bins, [=](const CalibrationBin& bin) { return bin.half_nis[kind]; }));
  consistency.push_back(over_depth("consistent", bins, [](const CalibrationBin&) { return 1.0; }));
  return {depth_chart("range", "standard deviation of the range [mm]", sd_and_bound(0)),
          depth_chart("bearing", "standard deviation of the bearing [mrad]", sd_and_bound(1)),
          depth_chart("consistency", "NIS / 2", std::move(consistency))};
}

}  // namespace

Page calibration_page(const CalibrationResult& result, std::span<const Gate> gates,
                      std::span<const std::string> words) {
  std::vector<std::uint64_t> seeds = result.fitted_seeds;
  seeds.insert(seeds.end(), result.held_out_seeds.begin(), result.held_out_seeds.end());
  std::ranges::sort(seeds);
  Page page{.title = result.scenario + ": a detector's noise",
            .facts = {"detector: " + result.detector, fmt::format("scenes {}", seeds_word(seeds)),
                      fmt::format("{} balls seen in the half held out", result.score.observations),
                      fmt::format("recall {:.4f}", result.score.recall()),
                      fmt::format("{} misidentified", result.score.misidentified),
                      fmt::format("stereobench {}", STEREOBENCH_VERSION)}};
  page.blocks = {gates_block(gates, calibration_json(result)),
                 bins_block(result.bins),
                 {.title = "Errors and consistency over depth",
                  .note = "Of balls that are seen whole.",
                  .content = PageCharts{charts_over_depth(result.bins)}}};
  if (words.empty()) return page;
  std::vector<std::string> line(words.begin(), words.end());
  line.insert(line.end(), {"--seeds", seeds_word(seeds)});
  for (Block& block : page.blocks) block.commands = {shell_line(line)};
  return page;
}

}  // namespace stereobench::harness
