#include "harness/sensitivity/sensitivity_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/report/axes.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr double kTop_px = 46.0;
constexpr double kPlotWidth_px = 620.0;
constexpr double kFactorHeight_px = 56.0;
constexpr double kBelow_px = 54.0;
constexpr double kBarHeight = 0.34;  // of the height of a factor
constexpr Colour kFirst = {0.0, 0.447, 0.698, 1.0};
constexpr Colour kTotal = {0.902, 0.624, 0.0, 1.0};
constexpr Colour kWhisker = {0.13, 0.13, 0.13, 1.0};

/// From 0, or the lowest interval, to 1, or the highest.
AxisRange range_of_shares(const SobolIndices& indices) {
  std::vector<double> ends = {0.0, 1.0};
  for (const FactorIndices& factor : indices.factors)
    for (const IndexEstimate& index : {factor.first, factor.total})
      ends.insert(ends.end(), {index.value, index.interval.low, index.interval.high});
  return range_of(ends, Scale::kLinear, 0.02);
}

/// A bar from 0 with a line for the interval. @param place on the vertical axis
void draw_bar(Canvas& canvas, const Axes& axes, const IndexEstimate& index, double place,
              const Colour& colour) {
  constexpr double kCap_px = 4.0;
  const double low = place - 0.5 * kBarHeight, high = place + 0.5 * kBarHeight;
  const std::array<Point, 4> corners = {{axes.to_pixel(0.0, low), axes.to_pixel(index.value, low),
                                         axes.to_pixel(index.value, high), axes.to_pixel(0.0, high)}};
  canvas.fill(corners, colour);
  const std::array<Point, 2> line = {
      {axes.to_pixel(index.interval.low, place), axes.to_pixel(index.interval.high, place)}};
  canvas.draw_line(line, {kWhisker, 1.3});
  for (const Point& end : line) {
    const std::array<Point, 2> cap = {{{end.x_px, end.y_px - kCap_px}, {end.x_px, end.y_px + kCap_px}}};
    canvas.draw_line(cap, {kWhisker, 1.3});
  }
}

/// The factors from the bottom to the top.
Axis factor_axis(const Sensitivity& study, const std::vector<std::size_t>& from_the_bottom) {
  Axis axis;
  for (const std::size_t factor : from_the_bottom) axis.categories.push_back(study.factors.name(factor));
  axis.range = {-0.5, std::max(1.0, static_cast<double>(from_the_bottom.size())) - 0.5};
  return axis;
}

double widest_name_px(const Axis& axis) {
  double widest = 0.0;
  const Canvas sheet(1, 1);
  for (const std::string& name : axis.categories)
    widest = std::max(widest, sheet.text_width_px(name, {.size_px = 12.0}));
  return widest;
}

}  // namespace

std::string draw_sensitivity_picture(const Sensitivity& study) {
  std::vector<std::size_t> order = order_by_total(study.indices);
  std::ranges::reverse(order);
  const Axis vertical = factor_axis(study, order);
  const Axis horizontal{fmt::format("share of the variance of {}", study.metric),
                        range_of_shares(study.indices)};
  const std::vector<LegendEntry> legend = {
      {"first", "this factor alone", Mark::kLine, {kFirst, 9.0}},
      {"total", "with interactions", Mark::kLine, {kTotal, 9.0}},
      {fmt::format("{:g} % interval", 100.0 * study.settings.level), "", Mark::kLine, {kWhisker, 1.3}}};
  const double left_px = std::max(40.0, widest_name_px(vertical) + 18.0);
  const double height_px = std::max(2.0, static_cast<double>(order.size())) * kFactorHeight_px;
  const double legend_px = left_px + kPlotWidth_px + 18.0;
  Canvas canvas(chart_width_px(legend_px, legend), static_cast<int>(kTop_px + height_px + kBelow_px));
  const Axes axes(horizontal, vertical, {left_px, kTop_px, kPlotWidth_px, height_px});
  axes.draw(canvas);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto place = static_cast<double>(i);
    const FactorIndices& indices = study.indices.factors[order[i]];
    draw_bar(canvas, axes, indices.first, place + 0.5 * kBarHeight, kFirst);
    draw_bar(canvas, axes, indices.total, place - 0.5 * kBarHeight, kTotal);
  }
  draw_legend(canvas, {legend_px, kTop_px}, legend);
  canvas.write(
      {left_px, 0.5 * kTop_px},
      fmt::format("{}: what matters to {}, {} samples", study.scenario, study.metric, study.settings.samples),
      {.size_px = 15.0, .bold = true});
  return canvas.png();
}

}  // namespace stereobench::harness
