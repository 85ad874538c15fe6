#include "harness/budget/budget_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/report/axes.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostPanels = 8;
constexpr double kLeft_px = 84.0;
constexpr double kTop_px = 42.0;
constexpr double kPlotWidth_px = 730.0;
constexpr double kLegend_px = kLeft_px + kPlotWidth_px + 18.0;
constexpr double kPlotHeight_px = 270.0;
constexpr double kPanel_px = kPlotHeight_px + 84.0;  ///< with its title and the label of its axis

constexpr Colour kKeepsColour = {0.0, 0.447, 0.698,
                                 0.7};  // blue, vermilion and bluish green of Okabe and Ito
constexpr Colour kBreaksColour = {0.835, 0.369, 0.0, 0.7};
constexpr Stroke kLimit = {kBlack, 1.4, Dash::kDashed};
constexpr Stroke kBudget = {{0.0, 0.620, 0.451, 1.0}, 2.0};
constexpr Stroke kNoValue = {{0.835, 0.369, 0.0, 1.0}, 1.6};

std::vector<double> levels_run(const Budget& budget) {
  std::vector<double> levels;
  for (const BudgetRun& run : budget.runs) levels.push_back(run.level);
  return levels;
}

Axis level_axis(const BudgetAnswer& answer) {
  const std::vector<double> levels = levels_run(answer.budget);
  Axis axis{.label = answer.mix.size() == 1 ? name_of(answer.mix) : "of the way: " + name_of(answer.mix)};
  const bool has_signs = std::ranges::any_of(levels, [](double level) { return level < 0.0; });
  const std::array ends = {answer.budget.level, std::ranges::max(levels)};
  axis.scale = has_signs ? Scale::kLinear : scale_for(ends);
  axis.range = range_of(levels, axis.scale);
  return axis;
}

Axis value_axis_of(const BudgetStudy& study, const Budget& budget) {
  std::vector<double> values = {study.limit.limit};
  for (const BudgetRun& run : budget.runs) values.push_back(run.value);
  Axis axis{.label = study.limit.metric};
  const bool has_signs = std::ranges::any_of(values, [](double value) { return value < 0.0; });
  axis.scale = has_signs ? Scale::kLinear : scale_for(values);
  axis.range = range_of(values, axis.scale, 0.08);
  return axis;
}

void draw_runs(Canvas& canvas, const Axes& axes, const Gate& limit, const Budget& budget) {
  const double top_px = axes.plot().top_px + 8.0;
  for (const BudgetRun& run : budget.runs) {
    const bool keeps = keeps_limit(limit, run.value);
    const Point at = axes.to_pixel(run.level, run.value);
    if (std::isfinite(at.y_px))
      draw_disc(canvas, at, 3.4, keeps ? kKeepsColour : kBreaksColour);
    else if (!keeps)
      draw_cross(canvas, {at.x_px, top_px}, 4.0, kNoValue);
  }
}

void draw_answer(Canvas& canvas, const BudgetStudy& study, const BudgetAnswer& answer, double top_px) {
  const Budget& budget = answer.budget;
  const Axis across = level_axis(answer);
  const Axes axes(across, value_axis_of(study, budget), {kLeft_px, top_px, kPlotWidth_px, kPlotHeight_px});
  canvas.write({kLeft_px, top_px - 12.0}, budget_in_short(answer), {.bold = true});
  axes.draw(canvas);
  canvas.clip_to(axes.plot());
  const std::array limit = {axes.to_pixel(across.range.low, study.limit.limit),
                            axes.to_pixel(across.range.high, study.limit.limit)};
  canvas.draw_line(limit, kLimit);
  if (budget.outcome != BudgetOutcome::kNone) {
    const double x_px = axes.to_pixel(budget.level, study.limit.limit).x_px;
    const std::array<Point, 2> upright = {{{x_px, top_px}, {x_px, top_px + kPlotHeight_px}}};
    canvas.draw_line(upright, kBudget);
  }
  draw_runs(canvas, axes, study.limit, budget);
  canvas.clip_to({});
}

std::vector<LegendEntry> budget_legend(const BudgetStudy& study) {
  return {{"keeps the limit", "a run: one seed at one level", Mark::kDisc, {kKeepsColour}},
          {"breaks the limit", "", Mark::kDisc, {kBreaksColour}},
          {"has no value", "", Mark::kCross, kNoValue},
          {"limit", limit_in_words(study.limit), Mark::kLine, kLimit},
          {"budget", in_words(study.wanted), Mark::kLine, kBudget}};
}

}  // namespace

std::string draw_budget_picture(const BudgetStudy& study) {
  const std::size_t panels = std::min(study.answers.size(), kMostPanels);
  const std::vector<LegendEntry> legend = budget_legend(study);
  Canvas canvas(chart_width_px(kLegend_px, legend),
                static_cast<int>(kTop_px + static_cast<double>(panels) * kPanel_px));
  canvas.write({kLeft_px, 0.4 * kTop_px}, study.scenario + ": " + limit_in_words(study.limit),
               {.size_px = 15.0, .bold = true});
  for (std::size_t i = 0; i < panels; ++i)
    draw_answer(canvas, study, study.answers[i], kTop_px + static_cast<double>(i) * kPanel_px + 22.0);
  draw_legend(canvas, {kLegend_px, kTop_px + 22.0}, legend);
  return canvas.png();
}

}  // namespace stereobench::harness
