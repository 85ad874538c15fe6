#include "harness/report/plan_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

constexpr double kSide_px = 900.0;      // the longer side of the plan
constexpr double kSheetLeft_px = 62.0;  // room for the coordinates
constexpr double kRight_px = 30.0;
constexpr double kSheetTop_px = 30.0;
constexpr double kSheetBottom_px = 46.0;
constexpr double kText_px = 62.0;       // below it
constexpr double kLeastGrid_px = 60.0;  // between two grid lines

}  // namespace

PlanSheet::PlanSheet(const Eigen::AlignedBox2d& extent_m)
    : extent_(extent_m), scale_(kSide_px / std::max(extent_m.sizes().maxCoeff(), 1e-3)) {}

double PlanSheet::x(const Eigen::Vector2d& at_m) const {
  return kSheetLeft_px + scale_ * (at_m.x() - extent_.min().x());
}

double PlanSheet::y(const Eigen::Vector2d& at_m) const {
  return kSheetTop_px + scale_ * (extent_.max().y() - at_m.y());
}

double PlanSheet::bottom_px() const {
  return kSheetTop_px + scale_ * extent_.sizes().y() + kSheetBottom_px;
}

std::string PlanSheet::point(const Eigen::Vector2d& at_m) const {
  return fmt::format("{:.1f},{:.1f}", x(at_m), y(at_m));
}

void PlanSheet::line(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, std::string_view style) {
  body_ += fmt::format("<path d=\"M{} L{}\" {}/>\n", point(from_m), point(to_m), style);
}

void PlanSheet::disc(const Eigen::Vector2d& at_m, double radius_px, std::string_view style) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", x(at_m), y(at_m), radius_px,
                       style);
}

void PlanSheet::polygon(std::span<const Eigen::Vector2d> corners_m, std::string_view style) {
  std::vector<std::string> points;
  for (const Eigen::Vector2d& corner : corners_m) points.push_back(point(corner));
  body_ += fmt::format("<polygon points=\"{}\" {}/>\n", fmt::join(points, " "), style);
}

void PlanSheet::label(const Eigen::Vector2d& at_m, const Eigen::Vector2d& shift_px, std::string_view words,
                      std::string_view style) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x(at_m) + shift_px.x(),
                       y(at_m) + shift_px.y(), style, words);
}

void PlanSheet::text(double x_px, int row, std::string_view words, std::string_view style) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", kSheetLeft_px + x_px,
                       bottom_px() + 18.0 * (row + 1), style, words);
}

/// 1, 2 or 5 times a power of ten, the least that leaves room between two lines.
double PlanSheet::grid_m() const {
  double decade_m = 1e-6;
  while (to_px(10.0 * decade_m) < kLeastGrid_px) decade_m *= 10.0;
  for (const double factor : {1.0, 2.0, 5.0})
    if (to_px(factor * decade_m) >= kLeastGrid_px) return factor * decade_m;
  return 10.0 * decade_m;
}

void PlanSheet::grid_line(int axis, double at_m, int decimals) {
  Eigen::Vector2d from = extent_.min();
  Eigen::Vector2d to = extent_.max();
  from[axis] = to[axis] = at_m;
  line(from, to, "stroke=\"#ddd\" stroke-width=\"1\"");
  const std::string number = fmt::format("{:.{}f}", at_m == 0.0 ? 0.0 : at_m, decimals);
  if (axis == 0)
    label(from, {0.0, 18.0}, number, "fill=\"#555\" font-size=\"12\" text-anchor=\"middle\"");
  else
    label(from, {-7.0, 4.0}, number, "fill=\"#555\" font-size=\"12\" text-anchor=\"end\"");
}

void PlanSheet::axes() {
  const double step_m = grid_m();
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step_m) + 1e-9)));
  for (int axis = 0; axis < 2; ++axis) {
    const double first = std::ceil(extent_.min()[axis] / step_m - 1e-9);
    const double last = std::floor(extent_.max()[axis] / step_m + 1e-9);
    for (double i = first; i <= last; ++i) grid_line(axis, i * step_m, decimals);
  }
  const Eigen::Vector2d low = extent_.min();
  const Eigen::Vector2d high = extent_.max();
  polygon(std::array<Eigen::Vector2d, 4>{low, {high.x(), low.y()}, high, {low.x(), high.y()}},
          "fill=\"none\" stroke=\"#999\" stroke-width=\"1\"");
  label({high.x(), low.y()}, {0.0, 36.0}, "x, east [m]",
        "fill=\"#555\" font-size=\"12\" text-anchor=\"end\"");
  label({low.x(), high.y()}, {-50.0, -12.0}, "y, north [m]", "fill=\"#555\" font-size=\"12\"");
}

std::string PlanSheet::document() const {
  const double width_px = std::max(scale_ * extent_.sizes().x() + kSheetLeft_px + kRight_px, 680.0);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      width_px, bottom_px() + kText_px, body_);
}

}  // namespace stereobench::harness
