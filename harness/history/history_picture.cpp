#include "harness/history/history_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/report/axes.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostPanels = 12;
constexpr double kLeft_px = 84.0;
constexpr double kTop_px = 46.0;
constexpr double kPlotWidth_px = 790.0;
constexpr double kRight_px = 26.0;
constexpr double kPlotHeight_px = 150.0;
constexpr double kPanel_px = kPlotHeight_px + 56.0;  ///< with its title and the numbers of the results
constexpr double kBottom_px = 26.0;

constexpr Colour kWorse = {0.835, 0.369, 0.0, 1.0};  // vermilion and bluish green of Okabe and Ito
constexpr Colour kBetter = {0.0, 0.620, 0.451, 1.0};
constexpr Colour kMeans = {0.0, 0.447, 0.698, 1.0};

Colour colour_of(const HistoryStep& step) {
  if (step.is_worse()) return kWorse;
  return step.is_better() ? kBetter : kGrey;
}

/// A panel's axes, and where the first result is on the horizontal one.
struct Panel {
  Axes axes;
  double first = 1.0;

  Point at(double result, double value) const { return axes.to_pixel(first + result, value); }
};

/// As narrow as two numbers beside it allow: one alone says nothing of how large a step is.
AxisRange range_with_two_ticks(const std::vector<double>& means) {
  constexpr std::array kMargins = {0.12, 0.3, 0.5, 0.8};
  constexpr int kTicks = static_cast<int>(kPlotHeight_px / 38.0);  // as Axes has them
  AxisRange range;
  for (const double margin : kMargins) {
    range = range_of(means, Scale::kLinear, margin);
    if (ticks(range, Scale::kLinear, kTicks).size() > 1) break;
  }
  return range;
}

/// Few results have a number each, so that there is none between them.
Panel panel_of(const MetricHistory& metric, const Box& plot, bool is_last) {
  constexpr std::size_t kFew = 12;
  const std::size_t results = metric.means.size();
  Axis across{.label = is_last ? "result" : ""};
  for (std::size_t i = 0; i < results && results <= kFew; ++i)
    across.categories.push_back(fmt::format("{}", i + 1));
  const double first = across.categories.empty() ? 1.0 : 0.0;
  across.range = {first - 0.5, first + static_cast<double>(results) - 0.5};
  return {Axes(across, {"", range_with_two_ticks(metric.means)}, plot), first};
}

/// The level from a step to the next one, as a line.
void draw_level(Canvas& canvas, const Panel& panel, double level, std::size_t begin, std::size_t end) {
  const std::array<Point, 2> line = {panel.at(static_cast<double>(begin) - 0.4, level),
                                     panel.at(static_cast<double>(end) - 0.6, level)};
  canvas.draw_line(line, {kBlack, 1.2});
}

void draw_steps(Canvas& canvas, const Panel& panel, const MetricHistory& metric) {
  const std::vector<HistoryStep>& steps = metric.steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double x_px = panel.at(static_cast<double>(steps[i].result) - 0.5, 0.0).x_px;
    const Box& plot = panel.axes.plot();
    const std::array<Point, 2> line = {{{x_px, plot.top_px}, {x_px, plot.top_px + plot.height_px}}};
    canvas.draw_line(line, {colour_of(steps[i]), 2.0, Dash::kDashed});
    draw_level(canvas, panel, steps[i].before, i > 0 ? steps[i - 1].result : 0, steps[i].result);
  }
  if (!steps.empty()) draw_level(canvas, panel, steps.back().after, steps.back().result, metric.means.size());
}

/// "worse from 3 to 4"
std::string step_in_words(const HistoryStep& step) {
  return fmt::format("{} from {} to {}",
                     step.is_worse()    ? "worse"
                     : step.is_better() ? "better"
                                        : "within the margin",
                     step.result, step.result + 1);
}

/// Each step, or where there is no room for them how many there are, and the last one.
std::string steps_in_words(const std::vector<HistoryStep>& steps) {
  constexpr std::size_t kRoomFor = 2;
  if (steps.empty()) return "no step";
  if (steps.size() > kRoomFor)
    return fmt::format("{} steps, the last one {}", steps.size(), step_in_words(steps.back()));
  return step_in_words(steps.front()) + (steps.size() > 1 ? ", " + step_in_words(steps.back()) : "");
}

void draw_metric(Canvas& canvas, const MetricHistory& metric, double top_px, bool is_last) {
  constexpr TextStyle kName = {.size_px = 13.0, .bold = true};
  const Panel panel = panel_of(metric, {kLeft_px, top_px + 22.0, kPlotWidth_px, kPlotHeight_px}, is_last);
  canvas.write({kLeft_px, top_px + 10.0}, metric.metric, kName);
  canvas.write({kLeft_px + kPlotWidth_px, top_px + 10.0}, steps_in_words(metric.steps),
               {.size_px = 12.0, .colour = {0.35, 0.35, 0.35, 1.0}, .align_x = 1.0});
  panel.axes.draw(canvas);
  canvas.clip_to(panel.axes.plot());
  draw_steps(canvas, panel, metric);
  for (std::size_t i = 0; i < metric.means.size(); ++i) {
    const Point at = panel.at(static_cast<double>(i), metric.means[i]);
    if (std::isfinite(at.y_px)) draw_disc(canvas, at, 3.4, kMeans);
  }
  canvas.clip_to({});
}

}  // namespace

std::vector<const MetricHistory*> metrics_to_draw(const History& history, std::size_t most) {
  std::vector<const MetricHistory*> metrics;
  const auto add = [&](const MetricHistory& metric) {
    if (std::ranges::count(metrics, &metric) == 0) metrics.push_back(&metric);
  };
  for (const FoundStep& found : steps_of(history)) add(*found.metric);
  for (const MetricHistory& metric : history.metrics)
    if (metric.changed) add(metric);
  for (const MetricHistory& metric : history.metrics) add(metric);
  metrics.resize(std::min({metrics.size(), most, kMostPanels}));
  return metrics;
}

std::string draw_history_picture(const std::string& title, const std::vector<const MetricHistory*>& metrics) {
  const auto panels = static_cast<double>(metrics.size());
  Canvas canvas(static_cast<int>(kLeft_px + kPlotWidth_px + kRight_px),
                static_cast<int>(kTop_px + panels * kPanel_px + kBottom_px));
  canvas.write({kLeft_px, 22.0}, title, {.size_px = 16.0, .bold = true});
  for (std::size_t i = 0; i < metrics.size(); ++i)
    draw_metric(canvas, *metrics[i], kTop_px + static_cast<double>(i) * kPanel_px, i + 1 == metrics.size());
  return canvas.png();
}

}  // namespace stereobench::harness
