#include "harness/result_pages/filter_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/page/spaced_steps.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostDrawn = 500;  ///< steps of a line over time

PageCell text_cell(const std::string& text) {
  return {.text = text};
}

/// A count that should be 0.
PageCell fault_cell(long count) {
  PageCell cell = count_cell(count);
  if (count > 0) cell.mark = CellMark::kBad;
  return cell;
}

PageRow error_row(const RunResult& result, const FilterResult& filter, const PageCell& particles) {
  const FilterSummary& s = filter.summary;
  const Summary& landmarks_m = result.start_is_true ? s.landmark_rms_m : s.landmark_aligned_rms_m;
  return {{text_cell(filter.filter), particles, summary_cell(s.ate_rms_m), number_cell(s.ate_rms_m.max),
           number_cell(s.ate_aligned_rms_m.mean), number_cell(slam::kDegreesPerRad * s.heading_rms_rad.mean),
           number_cell(landmarks_m.mean), number_cell(s.anees.mean), number_cell(filter.efficiency),
           fault_cell(s.failures)}};
}

PageRow bound_cells(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound,
                    const std::string& name) {
  const auto over = [&](double BoundScore::*part) { return over_seeds(bounds, bound, part); };
  const Summary pose = over(&BoundScore::pose_rms_m);
  const PageCell none = text_cell("-");
  return {{text_cell(name), none, number_cell(pose.mean), number_cell(pose.max), none,
           number_cell(slam::kDegreesPerRad * over(&BoundScore::heading_rms_rad).mean),
           number_cell(over(&BoundScore::landmark_rms_m).mean), none, number_cell(1.0), none}};
}

Block error_block(const RunResult& result) {
  PageTable table{.header = {"filter", "particles", "ATE rms [m]", "worst seed [m]", "aligned [m]",
                             "heading [deg]",
                             result.start_is_true ? "landmarks [m]" : "landmarks, aligned [m]", "ANEES",
                             "ATE / bound", "failures"}};
  for (const FilterResult& filter : result.filters)
    table.rows.push_back(error_row(result, filter, count_cell(filter.summary.particles)));
  table.rows.push_back(error_row(result, result.batch, text_cell("-")));
  if (!result.bounds.empty()) {
    table.rows.push_back(bound_cells(result.bounds, &BoundScores::filtering, "bound (filtering)"));
    table.rows.push_back(bound_cells(result.bounds, &BoundScores::smoothing, "bound (smoothing)"));
  }
  return {.title = "Filters",
          .note = std::string(kIntervalNote) +
                  " ATE is the absolute trajectory error. ANEES is 1 for a filter that knows its own errors.",
          .content = std::move(table)};
}

PageCell percent_cell(double fraction) {
  if (!std::isfinite(fraction)) return text_cell("-");
  return {.text = fmt::format("{:.0f} %", 100.0 * fraction), .number = fraction};
}

Block consistency_block(const RunResult& result) {
  PageTable table{.header = {"filter", "NIS", "NIS if used", "runs off", "landmarks off", "refused",
                             "steps off", "path in 50 %", "path in 95 %", "path in 99 %", "map in 95 %",
                             "effective particles"}};
  for (const FilterResult& filter : result.filters) {
    const ConsistencySummary& c = filter.summary.consistency;
    const InnovationSummary& nis = c.innovations;
    table.rows.push_back(
        {{text_cell(filter.filter), number_cell(nis.nis.mean), number_cell(nis.nis_used.mean),
          count_cell(nis.runs_outside), count_cell(nis.landmarks_outside), count_cell(nis.sum.refused()),
          percent_cell(filter.summary.nees.fraction_outside), percent_cell(c.path[0].mean),
          percent_cell(c.path[1].mean), percent_cell(c.path[2].mean), percent_cell(c.map[1].mean),
          number_cell(c.effective_mean.mean)}});
  }
  return {.title = "Consistency of filters",
          .note =
              "NIS is 1 where what a filter sees is as far from what it expects as it says. Off are runs "
              "and landmarks outside of their 99 % band, and steps whose NEES is outside of the 95 % "
              "band. In are true places within a filter's ellipses of 50, 95 and 99 %.",
          .content = std::move(table)};
}

std::vector<double> seeds_as_x(const std::vector<std::uint64_t>& seeds) {
  std::vector<double> x;
  for (std::size_t i = 0; i < seeds.size(); ++i) x.push_back(static_cast<double>(i));
  return x;
}

std::vector<std::string> names_of(const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> names;
  for (const std::uint64_t seed : seeds) names.push_back(fmt::format("{}", seed));
  return names;
}

/// A metric of each filter on each seed.
Chart seed_chart(const RunResult& result, const std::string& metric, const std::string& label) {
  constexpr std::size_t kMostNames = 60;
  const auto& seeds = result.seeds;
  Chart chart{.name = label, .x_label = "seed", .y_label = label, .y_is_logarithmic = true};
  if (seeds.size() <= kMostNames) chart.x_names = names_of(seeds);
  for (const FilterResult& filter : result.filters) {
    const auto values = result.seed_metrics.find(fmt::format("filters.{}.{}", filter.filter, metric));
    if (values == result.seed_metrics.end() || values->second.size() != seeds.size()) continue;
    chart.series.push_back(
        {.name = filter.filter, .look = Look::kPoints, .x = seeds_as_x(seeds), .y = values->second});
  }
  return chart;
}

Block compared_block(const RunResult& result) {
  PageTable table{.header = {"filter", "minus", "ATE [m]", "p (Wilcoxon)"}};
  for (const Comparison& comparison : result.comparisons)
    table.rows.push_back(
        {{text_cell(comparison.filter), text_cell(comparison.other),
          summary_cell(comparison.ate_m.difference), number_cell(comparison.ate_m.p_value)}});
  return {.title = "Filters beside each other, seed by seed",
          .note =
              "The mean of the differences on the same seeds, with its 95 % interval; below 0 the first "
              "filter is better.",
          .content = std::move(table)};
}

/// A line over the drawn instants.
template <class ValueAt>
Series over_time(const std::string& name, const std::vector<double>& time_s, const ValueAt& value_at) {
  Series series{.name = name};
  for (const std::size_t k : spaced_steps(time_s.size(), kMostDrawn)) {
    series.x.push_back(time_s[k]);
    series.y.push_back(value_at(k));
  }
  return series;
}

Chart error_chart(const RunCurves& curves) {
  const std::vector<double>& time_s = curves.first.time_s;
  Chart chart{.x_label = "time [s]", .y_label = "position error, rms [m]", .y_is_logarithmic = true};
  for (const ErrorCurves& filter : curves.errors)
    chart.series.push_back(
        over_time(filter.filter(), time_s, [&](std::size_t k) { return filter.rms_m(k); }));
  const std::vector<double> bound_m = curves.bound_m();
  if (bound_m.size() != time_s.size() || bound_m.empty()) return chart;
  chart.series.push_back(over_time("bound", time_s, [&](std::size_t k) { return bound_m[k]; }));
  return chart;
}

/// Ratios over time, and the band that 95 % of consistent ones lie in: of the filter with the fewest degrees
/// of freedom at each step.
Chart ratio_chart(const std::string& label, const std::vector<double>& time_s,
                  const std::vector<std::string>& filters, const std::vector<std::vector<SquaredSum>>& sums) {
  Chart chart{.name = label, .x_label = "time [s]", .y_label = label, .y_is_logarithmic = true};
  Series band{.name = "95 % band", .look = Look::kBand};
  for (const std::size_t k : spaced_steps(time_s.size(), kMostDrawn)) {
    long least = 0;
    for (const std::vector<SquaredSum>& filter : sums) {
      const long degrees = k < filter.size() ? filter[k].degrees_of_freedom : 0;
      if (degrees > 0) least = least == 0 ? degrees : std::min(least, degrees);
    }
    const Band limits = chi_square_band(0.95, least);
    band.x.push_back(time_s[k]);
    band.low.push_back(limits.low);
    band.high.push_back(limits.high);
  }
  chart.series.push_back(std::move(band));
  for (std::size_t i = 0; i < filters.size(); ++i)
    chart.series.push_back(over_time(filters[i], time_s, [&](std::size_t k) {
      return k < sums[i].size() ? sums[i][k].ratio() : std::nan("");
    }));
  return chart;
}

}  // namespace

PageCell count_cell(long count) {
  return {.text = fmt::format("{}", count), .number = static_cast<double>(count)};
}

PageCell number_cell(double value) {
  if (!std::isfinite(value)) return text_cell("-");
  return {.text = format_number(value), .number = value};
}

PageCell summary_cell(const Summary& summary) {
  PageCell cell = number_cell(summary.mean);
  cell.text = format_interval(summary.mean, summary.half_width);
  return cell;
}

std::vector<Block> filter_tables(const RunResult& result) {
  return {error_block(result), consistency_block(result)};
}

std::vector<Block> seed_blocks(const RunResult& result) {
  Block seeds{.title = "Errors seed by seed",
              .note = "Each point is one drive: the filters of a seed saw the same pictures.",
              .content = PageCharts{{seed_chart(result, "ate_rms_m", "ATE rms [m]"),
                                     seed_chart(result, "landmark_rms_m", "landmarks, rms [m]"),
                                     seed_chart(result, "anees", "ANEES")}}};
  if (result.comparisons.empty()) return {std::move(seeds)};
  return {std::move(seeds), compared_block(result)};
}

std::vector<Block> time_blocks(const RunResult& result, const RunCurves& curves) {
  const std::vector<double>& time_s = curves.first.time_s;
  if (time_s.empty()) return {};
  std::vector<std::string> filters;
  std::vector<std::vector<SquaredSum>> nees;
  for (const FilterResult& filter : result.filters) {
    filters.push_back(filter.filter);
    nees.push_back(filter.summary.nees_by_step);
  }
  const std::string seeds = fmt::format("{} seed{}", curves.seeds, curves.seeds == 1 ? "" : "s");
  std::vector<Block> blocks;
  blocks.push_back({.title = "Error over time",
                    .note = fmt::format("Root mean square over {}. The bound is the least that is possible "
                                        "for filters (Cramer-Rao).",
                                        seeds),
                    .content = PageCharts{{error_chart(curves)}}});
  blocks.push_back(
      {.title = "Consistency over time",
       .note = fmt::format("ANEES holds errors against the stated covariance, NIS innovations, "
                           "both over {}: 1 is consistent, above is overconfident. 95 % of consistent "
                           "steps lie in the band.",
                           seeds),
       .content = PageCharts{{ratio_chart("ANEES", time_s, filters, nees),
                              ratio_chart("NIS", time_s, filters, curves.innovations)}}});
  return blocks;
}

}  // namespace stereobench::harness
