#include "harness/report/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "slam/filter_registry.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

constexpr Colour kVermillion = {0.835, 0.369, 0.0, 1.0};
constexpr Colour kBlue = {0.0, 0.447, 0.698, 1.0};
constexpr Colour kGreen = {0.0, 0.620, 0.451, 1.0};
constexpr Colour kPurple = {0.800, 0.475, 0.655, 1.0};
// For all others.
constexpr std::array<Colour, 3> kOtherColours = {
    {{0.902, 0.624, 0.0, 1.0}, {0.337, 0.706, 0.914, 1.0}, {0.400, 0.400, 0.0, 1.0}}};
constexpr std::array kDashes = {Dash::kSolid, Dash::kDashed, Dash::kDotted};
constexpr double kMarkWidth_px = 30.0;
constexpr TextStyle kText = {.size_px = 13.0};
constexpr TextStyle kDetail = {.size_px = 11.5, .colour = {0.35, 0.35, 0.35, 1.0}};

/// The same for a name wherever it is computed (FNV-1a), unlike std::hash.
std::uint32_t hash_of(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  return hash;
}

std::optional<Stroke> own_stroke(std::string_view filter) {
  if (filter == "dead_reckoning") return Stroke{kGrey, 1.6, Dash::kDashed};
  if (filter == "smoother") return Stroke{kPurple, 1.8};
  if (filter == "fastslam2") return Stroke{kVermillion, 1.8};
  if (filter == "ufastslam") return Stroke{kBlue, 1.8};
  if (filter == "fastslam2_block") return Stroke{kVermillion, 1.8, Dash::kDashed};
  if (filter == "ufastslam_block") return Stroke{kBlue, 1.8, Dash::kDashed};
  if (filter == "batch") return Stroke{kGreen, 1.8};
  return {};
}

Stroke other_stroke(std::size_t number) {
  const std::size_t colours = kOtherColours.size();
  return {kOtherColours[number % colours], 1.8, kDashes[number / colours % kDashes.size()]};
}

std::vector<Point> circle(const Point& centre, double radius_x_px, double radius_y_px) {
  constexpr int kCorners = 48;
  std::vector<Point> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * slam::kPi * i / kCorners;
    points.push_back(
        {centre.x_px + radius_x_px * std::cos(angle), centre.y_px + radius_y_px * std::sin(angle)});
  }
  return points;
}

void draw_mark(Canvas& canvas, const Point& left, const LegendEntry& entry) {
  const Point centre = {left.x_px + 0.4 * kMarkWidth_px, left.y_px};
  const std::array<Point, 2> line = {{left, {left.x_px + 0.8 * kMarkWidth_px, left.y_px}}};
  switch (entry.mark) {
    case Mark::kLine:
      return canvas.draw_line(line, entry.stroke);
    case Mark::kDisc:
      return draw_disc(canvas, centre, 5.0, entry.stroke.colour);
    case Mark::kCross:
      return draw_cross(canvas, centre, 4.0, entry.stroke);
    case Mark::kEllipse:
      return canvas.draw_line(circle(centre, 9.0, 5.0), entry.stroke);
    case Mark::kStart:
      return draw_arrowhead(canvas, centre, 0.0, entry.stroke.colour);
  }
}

}  // namespace

Stroke filter_stroke(const std::string& filter) {
  if (const auto own = own_stroke(filter)) return *own;
  std::size_t number = 0;  // among the filters without a look of their own
  for (const slam::FilterKind& kind : slam::filter_kinds()) {
    if (kind.name == filter) return other_stroke(number);
    if (!own_stroke(kind.name)) ++number;
  }
  return other_stroke(hash_of(filter));
}

std::string filter_title(const std::string& filter) {
  if (const slam::FilterKind* const kind = slam::find_filter_kind(filter)) return std::string(kind->title);
  if (filter == "batch") return "whole log at once";
  return filter;
}

void draw_disc(Canvas& canvas, const Point& centre, double radius_px, const Colour& colour) {
  const std::vector<Point> rim = circle(centre, radius_px, radius_px);
  canvas.fill(rim, colour);
  canvas.draw_line(rim, {{0.2, 0.2, 0.2, 1.0}, 0.8});
}

void draw_cross(Canvas& canvas, const Point& centre, double arm_px, const Stroke& stroke) {
  for (const double slope : {-1.0, 1.0}) {
    const std::array<Point, 2> arm = {{{centre.x_px - arm_px, centre.y_px - slope * arm_px},
                                       {centre.x_px + arm_px, centre.y_px + slope * arm_px}}};
    canvas.draw_line(arm, stroke);
  }
}

void draw_arrowhead(Canvas& canvas, const Point& centre, double heading_rad, const Colour& colour) {
  const auto corner = [&](double angle, double radius_px) {
    return Point{centre.x_px + radius_px * std::cos(heading_rad + angle),
                 centre.y_px - radius_px * std::sin(heading_rad + angle)};
  };
  const std::array<Point, 4> corners = {
      {corner(0.0, 10.0), corner(2.4, 9.0), corner(slam::kPi, 3.0), corner(-2.4, 9.0)}};
  canvas.fill(corners, colour);
}

void draw_legend(Canvas& canvas, const Point& at, const std::vector<LegendEntry>& entries) {
  double y = at.y_px + 8.0;
  for (const LegendEntry& entry : entries) {
    draw_mark(canvas, {at.x_px, y}, entry);
    canvas.write({at.x_px + kMarkWidth_px, y}, entry.text, kText);
    if (!entry.detail.empty()) {
      y += 16.0;
      canvas.write({at.x_px + kMarkWidth_px, y}, entry.detail, kDetail);
    }
    y += 23.0;
  }
}

double legend_width_px(const Canvas& canvas, const std::vector<LegendEntry>& entries) {
  double widest = 0.0;
  for (const LegendEntry& entry : entries) {
    widest = std::max(widest, canvas.text_width_px(entry.text, kText));
    widest = std::max(widest, canvas.text_width_px(entry.detail, kDetail));
  }
  return entries.empty() ? 0.0 : kMarkWidth_px + widest;
}

int chart_width_px(double left_px, const std::vector<LegendEntry>& entries) {
  constexpr double kMargin_px = 12.0;
  constexpr int kUsual_px = 1000;
  const double right_px = left_px + legend_width_px(Canvas(1, 1), entries) + kMargin_px;
  return std::max(kUsual_px, static_cast<int>(std::ceil(right_px)));
}

}  // namespace stereobench::harness
