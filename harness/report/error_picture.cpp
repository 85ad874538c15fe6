#include "harness/report/error_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/report/axes.h"
#include "harness/report/curves.h"
#include "harness/report/legend.h"

namespace stereobench::harness {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kHeight_px = 480;
constexpr Box kPlot = {76.0, 42.0, 740.0, 386.0};
constexpr int kNeesPanelHeight_px = 260;  ///< of normalised errors, below
constexpr Box kPanelPlot = {76.0, 512.0, 740.0, 176.0};
constexpr double kErrorLegend_px = kPlot.left_px + kPlot.width_px + 18.0;
constexpr Stroke kBoundStroke = {kBlack, 1.8, Dash::kDotted};

/// Rms, least and greatest error over the runs at each instant; NaN where no run has one.
struct Summary {
  std::vector<double> rms_at_m;
  std::vector<double> least_m;
  std::vector<double> greatest_m;
  double rms_m = 0.0;
};

double rms_of(const std::vector<double>& errors_m) {
  double sum = 0.0;
  double count = 0.0;
  for (const double error_m : errors_m) {
    if (!std::isfinite(error_m)) continue;
    sum += error_m * error_m;
    count += 1.0;
  }
  return std::sqrt(sum / count);  // 0 / 0: a run without errors has no rms
}

Summary summarise(const ErrorCurves& curves, std::size_t instants) {
  Summary summary;
  for (std::size_t i = 0; i < instants; ++i) {
    summary.rms_at_m.push_back(curves.rms_m(i));
    summary.least_m.push_back(curves.least_m(i));
    summary.greatest_m.push_back(curves.greatest_m(i));
  }
  summary.rms_m = curves.mean_rms_m();
  return summary;
}

Axis error_axis(const std::vector<Summary>& summaries, const std::vector<double>& bound_m) {
  std::vector<double> sizes_m;
  std::vector<double> ends_m = bound_m;
  if (!bound_m.empty()) sizes_m.push_back(rms_of(bound_m));
  for (const Summary& summary : summaries) {
    sizes_m.push_back(summary.rms_m);
    ends_m.insert(ends_m.end(), summary.least_m.begin(), summary.least_m.end());
    ends_m.insert(ends_m.end(), summary.greatest_m.begin(), summary.greatest_m.end());
  }
  Axis axis = {"position error [m]", {}, scale_for(sizes_m)};
  axis.range = range_of(ends_m, axis.scale);
  // Errors begin at zero. On a log scale the first ones must not push all others to the top.
  const double least_rms_m = range_of(sizes_m, Scale::kLog, 0.0).low;
  axis.range.low = axis.scale == Scale::kLinear ? 0.0 : std::max(axis.range.low, 0.1 * least_rms_m);
  return axis;
}

/// On a log scale zero lies nowhere: smaller errors are drawn at a floor below the axis.
void lift(std::vector<double>& errors_m, double floor_m) {
  for (double& error_m : errors_m) error_m = error_m < floor_m ? floor_m : error_m;
}

void lift(Summary& summary, double floor_m) {
  lift(summary.rms_at_m, floor_m);
  lift(summary.least_m, floor_m);
  lift(summary.greatest_m, floor_m);
}

void draw_curves(Canvas& canvas, const Axes& axes, const ErrorPicture& picture,
                 const std::vector<Summary>& summaries) {
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    draw_band(canvas, axes, picture.time_s, summaries[i].least_m, summaries[i].greatest_m,
              filter_stroke(picture.filters[i].filter()).colour);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    draw_curve(canvas, axes, picture.time_s, summaries[i].rms_at_m,
               filter_stroke(picture.filters[i].filter()));
  }
}

std::vector<LegendEntry> legend_of(const ErrorPicture& picture, const std::vector<Summary>& summaries) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const ErrorCurves& curves = picture.filters[i];
    entries.push_back({filter_title(curves.filter()),
                       fmt::format("rms {} m", format_number(summaries[i].rms_m)), Mark::kLine,
                       filter_stroke(curves.filter())});
  }
  if (!picture.bound_m.empty())
    entries.push_back({"Cramer-Rao bound", "of the rms over runs", Mark::kLine, kBoundStroke});
  return entries;
}

void draw_anees(Canvas& canvas, const ErrorPicture& picture, const Axis& time) {
  draw_anees_panel(canvas, picture.anees, time, picture.time_s, kPanelPlot);
  canvas.write({kPanelPlot.left_px, kPanelPlot.top_px - 14.0},
               "error over its claimed size, squared (ANEES): 1 is consistent, above is overconfident", {});
  const std::vector<LegendEntry> legend = {
      {"95 % band", "of each step, if consistent", Mark::kLine, {{0.84, 0.84, 0.84, 1.0}, 9.0}}};
  draw_legend(canvas, {kErrorLegend_px, kPanelPlot.top_px}, legend);
}

}  // namespace

void ErrorCurves::add(const std::vector<double>& errors_m) {
  if (errors_m.size() > instants_.size()) instants_.resize(errors_m.size());
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    const double error_m = errors_m[i];
    if (!std::isfinite(error_m)) continue;
    Instant& at = instants_[i];
    at.least_m = at.count > 0.0 ? std::min(at.least_m, error_m) : error_m;
    at.greatest_m = at.count > 0.0 ? std::max(at.greatest_m, error_m) : error_m;
    at.sum_m2 += error_m * error_m;
    at.count += 1.0;
  }
  const double rms_m = rms_of(errors_m);
  if (!std::isfinite(rms_m)) return;
  sum_of_rms_m_ += rms_m;
  runs_ += 1.0;
}

double ErrorCurves::rms_m(std::size_t instant) const {
  return is_known(instant) ? std::sqrt(instants_[instant].sum_m2 / instants_[instant].count) : kNone;
}

double ErrorCurves::least_m(std::size_t instant) const {
  return is_known(instant) ? instants_[instant].least_m : kNone;
}

double ErrorCurves::greatest_m(std::size_t instant) const {
  return is_known(instant) ? instants_[instant].greatest_m : kNone;
}

std::string draw_error_picture(const ErrorPicture& picture) {
  std::vector<Summary> summaries;
  for (const ErrorCurves& curves : picture.filters) {
    summaries.push_back(summarise(curves, picture.time_s.size()));
  }
  const Axis vertical = error_axis(summaries, picture.bound_m);
  for (Summary& summary : summaries) lift(summary, 0.9 * vertical.range.low);
  const Axis time = {picture.time_axis, range_of(picture.time_s, Scale::kLinear, 0.0)};
  const Axes axes(time, vertical, kPlot);

  const std::vector<LegendEntry> legend = legend_of(picture, summaries);
  Canvas canvas(chart_width_px(kErrorLegend_px, legend),
                kHeight_px + (picture.anees.any() ? kNeesPanelHeight_px : 0));
  axes.draw(canvas);
  canvas.clip_to(kPlot);
  draw_curves(canvas, axes, picture, summaries);
  draw_curve(canvas, axes, picture.time_s, picture.bound_m, kBoundStroke);
  canvas.clip_to({});
  draw_legend(canvas, {kErrorLegend_px, kPlot.top_px}, legend);
  canvas.write({kPlot.left_px, 0.5 * kPlot.top_px}, picture.title, {.size_px = 15.0, .bold = true});
  if (picture.anees.any()) draw_anees(canvas, picture, time);
  return canvas.png();
}

}  // namespace stereobench::harness
