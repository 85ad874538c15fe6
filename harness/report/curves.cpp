#include "harness/report/curves.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stereobench::harness {

void draw_curve(Canvas& canvas, const Axes& axes, const std::vector<double>& x, const std::vector<double>& y,
                const Stroke& stroke) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) points.push_back(axes.to_pixel(x[i], y[i]));
  canvas.draw_line(points, stroke);
}

void draw_band(Canvas& canvas, const Axes& axes, const std::vector<double>& x, const std::vector<double>& low,
               const std::vector<double>& high, Colour colour) {
  colour.alpha = 0.16;
  std::vector<Point> corners;
  const auto add = [&](std::size_t i, const std::vector<double>& y) {
    const Point point = axes.to_pixel(x[i], y[i]);
    if (std::isfinite(point.x_px) && std::isfinite(point.y_px)) corners.push_back(point);
  };
  for (std::size_t i = 0; i < x.size(); ++i) add(i, high);
  for (std::size_t i = x.size(); i-- > 0;) add(i, low);
  canvas.fill(corners, colour);
}

void draw_interval(Canvas& canvas, const Point& low, const Point& high, const Stroke& stroke) {
  constexpr double kCap_px = 4.0;
  const std::array<Point, 2> bar = {low, high};
  canvas.draw_line(bar, stroke);
  for (const Point& end : bar) {
    const std::array<Point, 2> cap = {{{end.x_px - kCap_px, end.y_px}, {end.x_px + kCap_px, end.y_px}}};
    canvas.draw_line(cap, stroke);
  }
}

}  // namespace stereobench::harness
