#include "harness/report/anees_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/report/curves.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr Stroke kConsistentStroke = {kGrey, 1.0, Dash::kDotted};

bool is_drawn(double anees) {
  return std::isfinite(anees) && anees > 0.0;
}

/// From the band, or less, to the greatest; what is far below it is as good as consistent.
AxisRange range_for(const AneesPanel& panel) {
  constexpr double kLeast = 0.02;
  std::vector<double> all = {1.0};
  for (const AneesCurve& curve : panel.filters) all.insert(all.end(), curve.anees.begin(), curve.anees.end());
  all.insert(all.end(), panel.high.begin(), panel.high.end());
  all.insert(all.end(), panel.low.begin(), panel.low.end());
  for (double& number : all) number = number < kLeast ? kLeast : number;
  return range_of(all, Scale::kLog);
}

}  // namespace

bool AneesPanel::any() const {
  return std::ranges::any_of(
      filters, [](const AneesCurve& curve) { return std::ranges::any_of(curve.anees, is_drawn); });
}

void draw_anees_panel(Canvas& canvas, const AneesPanel& panel, const Axis& time,
                      const std::vector<double>& time_s, const Box& plot) {
  const Axes axes(time, {"normalised error [-]", range_for(panel), Scale::kLog}, plot);
  axes.draw(canvas);
  canvas.clip_to(plot);
  draw_band(canvas, axes, time_s, panel.low, panel.high, kBlack);
  const std::array<Point, 2> consistent = {axes.to_pixel(time.range.low, 1.0),
                                           axes.to_pixel(time.range.high, 1.0)};
  canvas.draw_line(consistent, kConsistentStroke);
  for (const AneesCurve& curve : panel.filters)
    draw_curve(canvas, axes, time_s, curve.anees, filter_stroke(curve.filter));
  canvas.clip_to({});
}

}  // namespace stereobench::harness
