#include "harness/response/response_page.h"

#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "harness/response/response_words.h"

namespace stereobench::harness {
namespace {

using LevelValue = std::function<const ResponseValue&(const LevelError&)>;

Series points_of(const ResponseFit& fit, const CurveFit& curve, const LevelValue& value_of) {
  Series series{.name = curve.name, .look = Look::kPoints, .x = fit.levels, .y = {}, .low = {}, .high = {}};
  for (const LevelError& error : curve.levels) {
    const ResponseValue& value = value_of(error);
    series.y.push_back(value.value);
    series.low.push_back(value.interval.low);
    series.high.push_back(value.interval.high);
  }
  return series;
}

/// The law of a curve, drawn over the levels above 0.
Series line_of(const ResponseFit& fit, const CurveFit& curve) {
  constexpr int kStepsOfLevel = 8;
  Series series{.name = curve.name + ", law", .look = Look::kLine, .x = {}, .y = {}, .low = {}, .high = {}};
  for (std::size_t i = 0; i + 1 < fit.levels.size(); ++i) {
    if (!(fit.levels[i] > 0.0)) continue;
    for (int step = 0; step < kStepsOfLevel; ++step)
      series.x.push_back(fit.levels[i] + (fit.levels[i + 1] - fit.levels[i]) * step / kStepsOfLevel);
  }
  series.x.push_back(fit.levels.back());
  for (const double level : series.x) series.y.push_back(curve.law->law.at(level));
  return series;
}

Chart chart_of(const ResponseFit& fit, const std::string& label) {
  return {.name = label,
          .x_label = fit.parameter,
          .y_label = label,
          .x_is_logarithmic = true,
          .y_is_logarithmic = true};
}

PageCharts charts_of(const ResponseFit& fit) {
  Chart errors = chart_of(fit, "ATE, rms over seeds [m]");
  Chart ratios = chart_of(fit, "ATE / bound");
  const auto add = [&](const CurveFit& curve) {
    errors.series.push_back(
        points_of(fit, curve, [](const LevelError& error) -> const ResponseValue& { return error.error_m; }));
    if (curve.law && curve.law->holds) errors.series.push_back(line_of(fit, curve));
  };
  if (fit.bound) add(*fit.bound);
  for (const CurveFit& filter : fit.filters) {
    add(filter);
    ratios.series.push_back(points_of(
        fit, filter, [](const LevelError& error) -> const ResponseValue& { return error.over_bound; }));
  }
  PageCharts charts{{std::move(errors)}};
  if (fit.bound) charts.charts.push_back(std::move(ratios));
  return charts;
}

PageTable law_table(const ResponseFit& fit) {
  PageTable table;
  table.header = response_header(fit);
  const auto add = [&](const CurveFit& curve) {
    if (!curve.law) return;
    PageRow row;
    for (const std::string& text : response_row(fit, curve)) row.cells.push_back({.text = text});
    const ResponseLaw& law = *curve.law;
    const std::vector<double> numbers = {law.floor_m.value, law.slope.value, law.knee.value,
                                         law.exponent.value};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (std::isfinite(numbers[i])) row.cells[i + 1].number = numbers[i];
    table.rows.push_back(std::move(row));
  };
  if (fit.bound) add(*fit.bound);
  for (const CurveFit& filter : fit.filters) add(filter);
  return table;
}

}  // namespace

std::vector<Block> response_blocks(const ResponseFit& fit) {
  const std::vector<std::string> sentences = response_sentences(fit);
  if (sentences.empty()) return {};
  return {{.title = "Response to " + fit.parameter,
           .note = "In brackets are 95 % intervals, from seeds that are drawn anew.",
           .content = PageText{sentences}},
          {.title = "Floor, slope and knee",
           .note = "Of the ATE, rms over seeds: error^2 = floor^2 + slope^2 / (1 / level^2 + 1 / upper "
                   "knee^2). At the knee the sensor costs as much as all else.",
           .content = law_table(fit)},
          {.title = "Response curves",
           .note = "Bars are 95 % intervals. A logarithmic axis has no place for level 0: the laws follow "
                   "it, and response.png shows it.",
           .content = charts_of(fit)}};
}

}  // namespace stereobench::harness
