#include "harness/report/sweep_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/number_table.h"
#include "harness/report/axes.h"
#include "harness/report/curves.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr double kLeft_px = 84.0;
constexpr double kTop_px = 42.0;
constexpr double kPlotWidth_px = 730.0;
constexpr double kLegend_px = kLeft_px + kPlotWidth_px + 18.0;
constexpr double kPanelHeight_px = 190.0;
constexpr double kAtePanelHeight_px = 300.0;
constexpr double kPanelGap_px = 58.0;
constexpr Stroke kDetectionStroke = {{0.0, 0.620, 0.451, 1.0}, 1.8};

/// The varied parameter's axis, and where on it each value lies.
struct Parameter {
  Axis axis;
  std::vector<double> places;
};

Parameter parameter_of(const SweepPicture& picture) {
  Parameter parameter;
  parameter.axis.label = picture.parameter;
  for (const std::string& value : picture.values) {
    if (const std::optional<double> number = finite_number_in(value)) parameter.places.push_back(*number);
  }
  if (parameter.places.size() < picture.values.size()) {  // words among them: one after the other, by name
    parameter.axis.categories = picture.values;
    parameter.axis.range = {-0.5, static_cast<double>(picture.values.size()) - 0.5};
    parameter.places.resize(picture.values.size());
    std::iota(parameter.places.begin(), parameter.places.end(), 0.0);
    return parameter;
  }
  parameter.axis.scale = picture.log_parameter ? Scale::kLog : Scale::kLinear;
  parameter.axis.range = range_of(parameter.places, parameter.axis.scale, 0.06);
  return parameter;
}

/// @param log_ratio means farther apart than this factor get a logarithmic axis
Axis value_axis(const std::string& label, const std::vector<SweepCurve>& curves, double log_ratio) {
  std::vector<double> means;
  std::vector<double> all;
  for (const SweepCurve& curve : curves) {
    for (const MeanInterval& value : curve.values) {
      means.push_back(value.mean);
      all.insert(all.end(), {value.mean, value.low, value.high});
    }
  }
  Axis axis = {label, {}, scale_for(means, log_ratio)};
  if (axis.scale == Scale::kLog) {
    // An interval that reaches down to zero leaves the axis; the means decide where that begins.
    const double least_mean = range_of(means, Scale::kLog, 0.0).low;
    for (double& number : all) number = std::max(number, 0.3 * least_mean);
  }
  axis.range = range_of(all, axis.scale, 0.08);
  const bool none_below_zero = range_of(all, Scale::kLinear, 0.0).low >= 0.0;
  if (axis.scale == Scale::kLinear && none_below_zero) axis.range.low = 0.0;
  return axis;
}

/// One panel of the picture: curves over the varied parameter.
struct Panel {
  Axis horizontal;
  Axis vertical;
  Box plot;
  std::optional<Stroke> stroke = {};  ///< of all curves; each curve's filter has its own when there is none
};

/// Draws means with their intervals. @param shift_px moved to the right by so much
void draw_curve(Canvas& canvas, const Panel& panel, const std::vector<double>& places,
                const SweepCurve& curve, double shift_px) {
  const Stroke stroke = panel.stroke.value_or(filter_stroke(curve.name));
  const Axes axes(panel.horizontal, panel.vertical, panel.plot);
  const double floor = panel.vertical.scale == Scale::kLog ? panel.vertical.range.low : -HUGE_VAL;
  const auto at = [&](std::size_t i, double value) {
    const Point point = axes.to_pixel(places[i], std::max(value, floor));
    return Point{point.x_px + shift_px, point.y_px};
  };
  std::vector<Point> means;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const MeanInterval& value = curve.values[i];
    means.push_back(at(i, value.mean));
    draw_interval(canvas, at(i, value.low), at(i, value.high), {stroke.colour, 1.2});
    draw_disc(canvas, means.back(), 3.2, stroke.colour);
  }
  canvas.draw_line(means, stroke);
}

void draw_panel(Canvas& canvas, const Panel& panel, const std::vector<double>& places,
                const std::vector<SweepCurve>& curves) {
  constexpr double kSideBySide_px = 7.0;  // so that the intervals of several curves do not hide each other
  Axes(panel.horizontal, panel.vertical, panel.plot).draw(canvas);
  const double middle = 0.5 * (static_cast<double>(curves.size()) - 1.0);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    draw_curve(canvas, panel, places, curves[i], kSideBySide_px * (static_cast<double>(i) - middle));
  }
}

void check(const std::vector<SweepCurve>& curves, std::size_t values) {
  for (const SweepCurve& curve : curves) {
    if (curve.values.size() == values) continue;
    throw std::invalid_argument(
        fmt::format("the curve {} has {} values, the sweep has {}", curve.name, curve.values.size(), values));
  }
}

std::vector<LegendEntry> legend_of(const std::vector<SweepCurve>& ate_m) {
  std::vector<LegendEntry> entries;
  for (const SweepCurve& curve : ate_m) {
    entries.push_back({filter_title(curve.name), "", Mark::kLine, filter_stroke(curve.name)});
  }
  return entries;
}

}  // namespace

std::string draw_sweep_picture(const SweepPicture& picture) {
  check(picture.detection, picture.values.size());
  check(picture.ate_m, picture.values.size());
  const Parameter parameter = parameter_of(picture);
  const double detection_px =
      static_cast<double>(picture.detection.size()) * (kPanelHeight_px + kPanelGap_px);
  const std::vector<LegendEntry> legend = legend_of(picture.ate_m);
  Canvas canvas(chart_width_px(kLegend_px, legend),
                static_cast<int>(kTop_px + detection_px + kAtePanelHeight_px + kPanelGap_px));
  double top_px = kTop_px;
  for (const SweepCurve& curve : picture.detection) {
    const Box plot = {kLeft_px, top_px, kPlotWidth_px, kPanelHeight_px};
    draw_panel(canvas, {parameter.axis, value_axis(curve.name, {curve}, 100.0), plot, kDetectionStroke},
               parameter.places, {curve});
    top_px += kPanelHeight_px + kPanelGap_px;
  }
  const Box plot = {kLeft_px, top_px, kPlotWidth_px, kAtePanelHeight_px};
  const Panel panel = {parameter.axis, value_axis("ATE [m], mean and 95 %", picture.ate_m, 12.0), plot};
  draw_panel(canvas, panel, parameter.places, picture.ate_m);
  draw_legend(canvas, {kLegend_px, top_px}, legend);
  canvas.write({kLeft_px, 0.5 * kTop_px}, picture.title, {.size_px = 15.0, .bold = true});
  return canvas.png();
}

}  // namespace stereobench::harness
