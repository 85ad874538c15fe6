#include "harness/page/text_alternative.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/io/text_table.h"

namespace stereobench::harness {
namespace {

std::vector<double> finite_ones(const std::vector<double>& values) {
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  return finite;
}

std::string range_of(const std::vector<double>& values) {
  const auto [least, greatest] = std::ranges::minmax(values);
  return fmt::format("{} to {}", format_number(least), format_number(greatest));
}

std::string words_of(const Series& series) {
  if (series.look == Look::kBand) {
    std::vector<double> ends = finite_ones(series.low);
    std::ranges::copy(finite_ones(series.high), std::back_inserter(ends));
    return ends.empty() ? "nothing" : "a band within " + range_of(ends);
  }
  const std::vector<double> y = finite_ones(series.y);
  if (y.empty()) return "nothing";
  const std::string last =
      series.look == Look::kPoints ? "" : fmt::format(", the last {}", format_number(y.back()));
  return fmt::format("{} point{} from {}{}", y.size(), y.size() == 1 ? "" : "s", range_of(y), last);
}

}  // namespace

std::string text_alternative(const Chart& chart) {
  std::vector<double> x;
  for (const Series& series : chart.series) std::ranges::copy(finite_ones(series.x), std::back_inserter(x));
  std::string text = fmt::format("Chart of {} over {}", chart.y_label, chart.x_label);
  if (!x.empty() && chart.x_names.empty()) text += fmt::format(" from {}", range_of(x));
  text += ".";
  for (const Series& series : chart.series) text += fmt::format(" {}: {}.", series.name, words_of(series));
  return text;
}

std::string text_alternative(const PageMap& map) {
  std::string text =
      fmt::format("Map of {} instants with {} landmarks.", map.time_s.size(), map.landmarks.size());
  for (const PageEstimate& estimate : map.estimates) {
    const std::size_t steps = std::min(estimate.path.size(), map.truth.size());
    if (steps == 0 || !map.truth[steps - 1]) continue;
    const double error_m = (estimate.path[steps - 1] - map.truth[steps - 1]->head<2>()).norm();
    text += fmt::format(" {} ends {} m from the truth.", estimate.name, format_number(error_m));
  }
  return text;
}

}  // namespace stereobench::harness
