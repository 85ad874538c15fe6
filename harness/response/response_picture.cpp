#include "harness/response/response_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

#include "harness/report/axes.h"
#include "harness/report/curves.h"
#include "harness/report/legend.h"
#include "harness/response/response_words.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr double kLeft_px = 84.0;
constexpr double kTop_px = 42.0;
constexpr double kPlotWidth_px = 660.0;
constexpr double kErrorHeight_px = 360.0;
constexpr double kRatioHeight_px = 170.0;
constexpr double kGap_px = 58.0;
constexpr double kLegend_px = kLeft_px + kPlotWidth_px + 18.0;
constexpr double kLine_px = 19.0;
constexpr TextStyle kSentence = {.size_px = 13.0};

/// A curve and its look.
struct DrawnCurve {
  const CurveFit* fit = nullptr;
  Stroke stroke;
  std::string title;
};

std::vector<DrawnCurve> curves_of(const ResponseFit& fit) {
  std::vector<DrawnCurve> curves;
  if (fit.bound) curves.push_back({&*fit.bound, {kBlack, 1.8}, "Cramer-Rao bound"});
  for (const CurveFit& filter : fit.filters)
    curves.push_back({&filter, filter_stroke(filter.name), filter_title(filter.name)});
  return curves;
}

Axis level_axis(const ResponseFit& fit) {
  Axis axis = {
      .label = fit.parameter, .range = range_of(fit.levels, Scale::kLog, 0.06), .scale = Scale::kLog};
  axis.has_zero = !fit.levels.empty() && fit.levels.front() == 0.0;
  return axis;
}

using ValueOf = std::function<ResponseValue(const LevelError&)>;

Axis error_axis(const std::string& label, const std::vector<DrawnCurve>& curves, const ValueOf& value_of) {
  std::vector<double> all;
  for (const DrawnCurve& curve : curves)
    for (const LevelError& error : curve.fit->levels) {
      const ResponseValue value = value_of(error);
      all.insert(all.end(), {value.value, value.interval.low, value.interval.high});
    }
  return {.label = label, .range = range_of(all, Scale::kLog, 0.08), .scale = Scale::kLog};
}

/// One of the two panels.
struct ResponsePanel {
  const ResponseFit& fit;
  Axes axes;
  AxisRange levels;
  ValueOf value_of;
};

/// @param shift_px to the right, so that the intervals of several curves do not hide each other
void draw_errors(Canvas& canvas, const ResponsePanel& panel, const DrawnCurve& curve, double shift_px) {
  for (std::size_t i = 0; i < panel.fit.levels.size(); ++i) {
    const auto at = [&](double value) {
      const Point point = panel.axes.to_pixel(panel.fit.levels[i], value);
      return Point{point.x_px + shift_px, point.y_px};
    };
    const ResponseValue value = panel.value_of(curve.fit->levels[i]);
    const std::array<Point, 2> bar = {at(value.interval.low), at(value.interval.high)};
    canvas.draw_line(bar, {curve.stroke.colour, 1.4});
    if (std::isfinite(at(value.value).y_px)) draw_disc(canvas, at(value.value), 3.4, curve.stroke.colour);
  }
}

/// Joins the points, where there is no law to draw.
void draw_joined(Canvas& canvas, const ResponsePanel& panel, const DrawnCurve& curve) {
  std::vector<double> values;
  for (const LevelError& error : curve.fit->levels) values.push_back(panel.value_of(error).value);
  draw_curve(canvas, panel.axes, panel.fit.levels, values, {curve.stroke.colour, 1.2, Dash::kDotted});
}

/// Draws a function of the level over all levels above 0.
void draw_function(Canvas& canvas, const ResponsePanel& panel, const Stroke& stroke,
                   const std::function<double(double)>& value_at) {
  constexpr int kSteps = 96;
  const Box& plot = panel.axes.plot();
  std::vector<double> levels, values;
  const double ratio = panel.levels.high / panel.levels.low;
  for (int i = 0; i <= kSteps; ++i) {
    levels.push_back(panel.levels.low * slam::power(ratio, static_cast<double>(i) / kSteps));
    values.push_back(value_at(levels.back()));
  }
  canvas.clip_to(plot);
  draw_curve(canvas, panel.axes, levels, values, stroke);
  canvas.clip_to({});
}

/// A cross where the sensor costs as much as all else, its interval, and a line down to the level.
void draw_knee(Canvas& canvas, const ResponsePanel& panel, const DrawnCurve& curve) {
  const ResponseLaw& law = *curve.fit->law;
  const double error = law.law.at(law.knee.value);
  const Point centre = panel.axes.to_pixel(law.knee.value, error);
  const Box& plot = panel.axes.plot();
  if (!std::isfinite(centre.x_px) || !std::isfinite(centre.y_px) || !(law.knee.value > panel.levels.low) ||
      !(law.knee.value < panel.levels.high))
    return;
  canvas.clip_to(plot);
  const std::array<Point, 2> down = {{centre, {centre.x_px, plot.top_px + plot.height_px}}};
  canvas.draw_line(down, {curve.stroke.colour, 1.0, Dash::kDotted});
  const double low = std::max(law.knee.interval.low, panel.levels.low);
  const double high = std::min(law.knee.interval.high, panel.levels.high);
  const std::array<Point, 2> bar = {panel.axes.to_pixel(low, error), panel.axes.to_pixel(high, error)};
  canvas.draw_line(bar, {curve.stroke.colour, 3.0});
  draw_cross(canvas, centre, 6.0, {kBlack, 2.0});
  canvas.clip_to({});
}

bool has_law(const DrawnCurve& curve) {
  return curve.fit->law && curve.fit->law->holds;
}

void draw_all_errors(Canvas& canvas, const ResponsePanel& panel, const std::vector<DrawnCurve>& curves) {
  constexpr double kSideBySide_px = 4.0;
  const double middle = 0.5 * (static_cast<double>(curves.size()) - 1.0);
  for (std::size_t i = 0; i < curves.size(); ++i)
    draw_errors(canvas, panel, curves[i], kSideBySide_px * (static_cast<double>(i) - middle));
}

void draw_error_panel(Canvas& canvas, const ResponsePanel& panel, const std::vector<DrawnCurve>& curves) {
  panel.axes.draw(canvas);
  for (const DrawnCurve& curve : curves) {
    if (!has_law(curve))
      draw_joined(canvas, panel, curve);
    else
      draw_function(canvas, panel, curve.stroke, [&](double level) { return curve.fit->law->law.at(level); });
  }
  draw_all_errors(canvas, panel, curves);
  for (const DrawnCurve& curve : curves)
    if (has_law(curve)) draw_knee(canvas, panel, curve);
}

/// @param curves the bound first
void draw_ratio_panel(Canvas& canvas, const ResponsePanel& panel, std::vector<DrawnCurve> curves) {
  panel.axes.draw(canvas);
  const DrawnCurve bound = curves.front();
  curves.erase(curves.begin());
  draw_function(canvas, panel, bound.stroke, [](double) { return 1.0; });
  for (const DrawnCurve& curve : curves) {
    if (!has_law(curve) || !has_law(bound))
      draw_joined(canvas, panel, curve);
    else
      draw_function(canvas, panel, curve.stroke, [&](double level) {
        return curve.fit->law->law.at(level) / bound.fit->law->law.at(level);
      });
  }
  draw_all_errors(canvas, panel, curves);
}

std::vector<LegendEntry> legend_of(const ResponseFit& fit, const std::vector<DrawnCurve>& curves) {
  std::vector<LegendEntry> entries;
  for (const DrawnCurve& curve : curves) {
    std::string detail = "no law";
    if (has_law(curve)) detail = "knee " + knee_word(fit, *curve.fit->law);
    entries.push_back({curve.title, detail, Mark::kLine, curve.stroke});
  }
  entries.push_back({"knee", "sensor costs as much as the rest", Mark::kCross, {kBlack, 2.0}});
  return entries;
}

/// The words of a text in lines that are not wider than this.
std::vector<std::string> wrapped(const Canvas& canvas, const std::string& text, double width_px) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (canvas.text_width_px(longer, kSentence) <= width_px || lines.back().empty())
      lines.back() = longer;
    else
      lines.push_back("   " + word);
  }
  return lines;
}

std::vector<std::string> lines_of(const ResponseFit& fit, double width_px) {
  const Canvas canvas(1, 1);
  std::vector<std::string> lines;
  for (const std::string& sentence : response_sentences(fit))
    for (std::string& line : wrapped(canvas, sentence, width_px)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace

std::string draw_response_picture(const ResponseFit& fit, const std::string& title) {
  const std::vector<DrawnCurve> curves = curves_of(fit);
  const std::vector<LegendEntry> legend = legend_of(fit, curves);
  const int width_px = chart_width_px(kLegend_px, legend);
  const std::vector<std::string> lines = lines_of(fit, static_cast<double>(width_px) - 2.0 * kLine_px);
  const double panels_px = kErrorHeight_px + kGap_px + (fit.bound ? kRatioHeight_px + kGap_px : 0.0);
  Canvas canvas(width_px,
                static_cast<int>(kTop_px + panels_px + kLine_px * static_cast<double>(lines.size())));
  const Axis levels = level_axis(fit);
  const ValueOf error_of = [](const LevelError& error) { return error.error_m; };
  const Box upper = {kLeft_px, kTop_px, kPlotWidth_px, kErrorHeight_px};
  const Axis errors = error_axis("ATE, rms over seeds [m]", curves, error_of);
  draw_error_panel(canvas, {fit, Axes(levels, errors, upper), levels.range, error_of}, curves);
  if (fit.bound) {
    const ValueOf ratio_of = [](const LevelError& error) { return error.over_bound; };
    const Box lower = {kLeft_px, kTop_px + kErrorHeight_px + kGap_px, kPlotWidth_px, kRatioHeight_px};
    const Axis ratios = error_axis("ATE / bound", curves, ratio_of);
    draw_ratio_panel(canvas, {fit, Axes(levels, ratios, lower), levels.range, ratio_of}, curves);
  }
  draw_legend(canvas, {kLegend_px, kTop_px}, legend);
  for (std::size_t i = 0; i < lines.size(); ++i)
    canvas.write({kLine_px, kTop_px + panels_px + kLine_px * (static_cast<double>(i) + 0.2)}, lines[i],
                 kSentence);
  canvas.write({kLeft_px, 0.5 * kTop_px}, title, {.size_px = 15.0, .bold = true});
  return canvas.png();
}

}  // namespace stereobench::harness
