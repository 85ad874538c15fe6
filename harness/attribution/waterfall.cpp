#include "harness/attribution/waterfall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/report/axes.h"
#include "harness/report/curves.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr int kWidth_px = 1000;
constexpr double kLeft_px = 90.0;
constexpr double kTop_px = 62.0;
constexpr double kPlotHeight_px = 220.0;
constexpr double kPanel_px = 290.0;
constexpr Colour kWhole = {0.35, 0.35, 0.35, 1.0};
constexpr Colour kTaken = {0.0, 0.447, 0.698, 1.0};  // Okabe and Ito's blue
constexpr Colour kAdded = {0.835, 0.369, 0.0, 1.0};  // and vermillion

/// A bar from one error to another.
struct Step {
  std::string name;
  double from = 0.0;
  double to = 0.0;
  double half_width = 0.0;  ///< of the interval, around `to`
  Colour colour = kWhole;
};

std::vector<Step> steps_of(const AttributedMetric& metric) {
  std::vector<Step> steps = {{"as it is", 0.0, metric.real.mean, metric.real.half_width, kWhole}};
  double left = metric.real.mean;
  for (const PartSummary& part : metric.parts) {
    const double taken = part.share.mean;
    steps.push_back({part.part, left, left - taken, part.share.half_width, taken < 0.0 ? kAdded : kTaken});
    left -= taken;
  }
  steps.push_back({"all perfect", 0.0, metric.perfect.mean, metric.perfect.half_width, kWhole});
  return steps;
}

void draw_step(Canvas& canvas, const Axes& axes, double place, const Step& step) {
  constexpr double kHalf = 0.32;
  const auto at = [&](double x, double y) { return axes.to_pixel(place + x, y); };
  const std::array<Point, 4> bar = {at(-kHalf, step.from), at(kHalf, step.from), at(kHalf, step.to),
                                    at(-kHalf, step.to)};
  canvas.fill(bar, step.colour);
  if (!std::isfinite(step.half_width)) return;
  draw_interval(canvas, at(0.0, step.to - step.half_width), at(0.0, step.to + step.half_width),
                {kBlack, 1.4});
}

/// The level that a step ends at, over to the next bar.
void draw_level(Canvas& canvas, const Axes& axes, double place, double level) {
  const std::array<Point, 2> line = {axes.to_pixel(place + 0.32, level), axes.to_pixel(place + 0.68, level)};
  canvas.draw_line(line, {kGrey, 1.0, Dash::kDotted});
}

AxisRange range_of_steps(const std::vector<Step>& steps) {
  std::vector<double> numbers = {0.0};
  for (const Step& step : steps) {
    const double half = std::isfinite(step.half_width) ? step.half_width : 0.0;
    numbers.insert(numbers.end(), {step.from, step.to - half, step.to + half});
  }
  AxisRange range = range_of(numbers, Scale::kLinear, 0.06);
  if (*std::ranges::min_element(numbers) >= 0.0) range.low = 0.0;
  return range;
}

void draw_panel(Canvas& canvas, const AttributedMetric& metric, double top_px) {
  const std::vector<Step> steps = steps_of(metric);
  Axis horizontal{.label = "", .range = {-0.6, static_cast<double>(steps.size()) - 0.4}};
  for (const Step& step : steps) horizontal.categories.push_back(step.name);
  const std::string unit = metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit);
  const Axis vertical{.label = metric.metric + unit, .range = range_of_steps(steps)};
  const Axes axes(horizontal, vertical, {kLeft_px, top_px, kWidth_px - kLeft_px - 20.0, kPlotHeight_px});
  canvas.write({kLeft_px, top_px - 14.0}, filter_title(metric.filter), {.bold = true});
  axes.draw(canvas);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    draw_step(canvas, axes, static_cast<double>(i), steps[i]);
    if (i + 1 < steps.size()) draw_level(canvas, axes, static_cast<double>(i), steps[i].to);
  }
}

}  // namespace

std::string draw_waterfalls(const Attribution& attribution, const std::string& metric) {
  std::vector<const AttributedMetric*> shown;
  for (const AttributedMetric& one : attribution.metrics)
    if (one.metric == metric) shown.push_back(&one);
  Canvas canvas(
      kWidth_px,
      static_cast<int>(kTop_px + kPanel_px * static_cast<double>(std::max<std::size_t>(shown.size(), 1))));
  canvas.write({kLeft_px, 20.0},
               fmt::format("{}: whose the error is, {}", attribution.scenario,
                           seeds_in_words(attribution.seeds.size())),
               {.size_px = 16.0, .bold = true});
  for (std::size_t i = 0; i < shown.size(); ++i)
    draw_panel(canvas, *shown[i], kTop_px + kPanel_px * static_cast<double>(i));
  return canvas.png();
}

}  // namespace stereobench::harness
