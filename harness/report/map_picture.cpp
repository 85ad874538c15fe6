#include "harness/report/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/report/ellipse.h"
#include "harness/report/legend.h"
#include "vision/palette.h"

namespace stereobench::harness {
namespace {

constexpr int kWidth_px = 1000;
constexpr double kMapLeft_px = 68.0;
constexpr double kMapTop_px = 42.0;
constexpr double kMapBottom_px = 52.0;
constexpr double kGap_px = 18.0;
constexpr Stroke kTruthStroke = {kBlack, 4.8};
constexpr Stroke kWallStroke = {{0.62, 0.62, 0.62, 1.0}, 1.2};

/// Paths that lie on each other are all seen: the truth is the widest, each filter's narrower than the one
/// below.
std::vector<Stroke> path_strokes(const std::vector<MapEstimate>& estimates) {
  std::vector<Stroke> strokes;
  double width_px = 3.2;
  for (const MapEstimate& estimate : estimates) {
    strokes.push_back(filter_stroke(estimate.filter));
    if (strokes.back().dash != Dash::kSolid) continue;
    strokes.back().width_px = width_px;
    width_px = std::max(1.2, width_px - 1.6);
  }
  return strokes;
}

/// Everything's coordinates, to find out how large the map is.
struct MapExtent {
  std::vector<double> x_m;
  std::vector<double> y_m;

  void include(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    x_m.push_back(x);
    y_m.push_back(y);
  }
  void include(const std::vector<slam::Pose>& path) {
    for (const slam::Pose& pose : path) include(pose.x_m, pose.y_m);
  }
};

MapExtent extent_of(const MapPicture& picture) {
  MapExtent extent;
  for (const worlds::Wall& wall : picture.walls) {
    extent.include(wall.from_m.x(), wall.from_m.y());
    extent.include(wall.to_m.x(), wall.to_m.y());
  }
  extent.include(picture.true_path);
  for (const LandmarkTruth& landmark : picture.landmarks) {
    extent.include(landmark.position_m.x(), landmark.position_m.y());
  }
  for (const MapEstimate& estimate : picture.estimates) {
    extent.include(estimate.path);
    for (const slam::LandmarkEstimate& landmark : estimate.landmarks) {
      extent.include(landmark.position_m.x(), landmark.position_m.y());
    }
  }
  return extent;
}

bool has_ball_colour(const LandmarkTruth& landmark) {
  return landmark.colour_class >= 0 && landmark.colour_class < static_cast<int>(vision::kPalette.size());
}

std::vector<LegendEntry> legend_of(const MapPicture& picture) {
  std::vector<LegendEntry> entries;
  if (!picture.true_path.empty()) entries.push_back({"truth", "", Mark::kLine, kTruthStroke});
  const std::vector<Stroke> strokes = path_strokes(picture.estimates);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    entries.push_back({filter_title(picture.estimates[i].filter), "", Mark::kLine, strokes[i]});
  }
  if (!picture.true_path.empty()) entries.push_back({"start", "", Mark::kStart, {kBlack}});
  if (!picture.landmarks.empty()) {
    const bool disc = has_ball_colour(picture.landmarks.front());
    entries.push_back({"true landmark", "", disc ? Mark::kDisc : Mark::kCross, {kGrey, 1.6}});
  }
  const bool any_map = std::any_of(picture.estimates.begin(), picture.estimates.end(),
                                   [](const MapEstimate& estimate) { return !estimate.landmarks.empty(); });
  if (any_map) entries.push_back({"estimated landmark", "95 % ellipse", Mark::kEllipse, {kGrey, 1.2}});
  return entries;
}

/// As high as the map needs at the sheet's width, within what fits a screen.
int height_for(const AxisRange& x, const AxisRange& y, double plot_width_px) {
  const double plot_height_px = plot_width_px * (y.high - y.low) / (x.high - x.low);
  return static_cast<int>(std::clamp(plot_height_px, 400.0, 860.0) + kMapTop_px + kMapBottom_px);
}

void draw_path(Canvas& canvas, const Axes& axes, const std::vector<slam::Pose>& path, const Stroke& stroke) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const slam::Pose& pose : path) points.push_back(axes.to_pixel(pose.x_m, pose.y_m));
  canvas.draw_line(points, stroke);
}

void draw_true_landmark(Canvas& canvas, const Axes& axes, const LandmarkTruth& landmark) {
  const Point at = axes.to_pixel(landmark.position_m.x(), landmark.position_m.y());
  if (!has_ball_colour(landmark)) return draw_cross(canvas, at, 4.0, {kBlack, 1.4});
  const auto [r, g, b] = vision::kPalette[static_cast<std::size_t>(landmark.colour_class)];
  draw_disc(canvas, at, 6.0, {r / 255.0, g / 255.0, b / 255.0, 1.0});
}

void draw_estimated_landmark(Canvas& canvas, const Axes& axes, const slam::LandmarkEstimate& landmark,
                             Stroke stroke) {
  stroke.dash = Dash::kSolid;
  stroke.width_px = 1.2;
  std::vector<Point> outline;
  for (const Eigen::Vector2d& point : ellipse_95(landmark.position_m, landmark.covariance)) {
    outline.push_back(axes.to_pixel(point.x(), point.y()));
  }
  canvas.draw_line(outline, stroke);
  draw_cross(canvas, axes.to_pixel(landmark.position_m.x(), landmark.position_m.y()), 2.5, stroke);
}

void draw_estimates(Canvas& canvas, const Axes& axes, const std::vector<MapEstimate>& estimates) {
  const std::vector<Stroke> strokes = path_strokes(estimates);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    draw_path(canvas, axes, estimates[i].path, strokes[i]);
    for (const slam::LandmarkEstimate& landmark : estimates[i].landmarks) {
      draw_estimated_landmark(canvas, axes, landmark, strokes[i]);
    }
  }
}

void draw_contents(Canvas& canvas, const Axes& axes, const MapPicture& picture) {
  for (const worlds::Wall& wall : picture.walls) {
    const std::array<Point, 2> line = {axes.to_pixel(wall.from_m.x(), wall.from_m.y()),
                                       axes.to_pixel(wall.to_m.x(), wall.to_m.y())};
    canvas.draw_line(line, kWallStroke);
  }
  for (const LandmarkTruth& landmark : picture.landmarks) draw_true_landmark(canvas, axes, landmark);
  draw_path(canvas, axes, picture.true_path, kTruthStroke);
  draw_estimates(canvas, axes, picture.estimates);
  if (!picture.true_path.empty()) {
    const slam::Pose& start = picture.true_path.front();
    draw_arrowhead(canvas, axes.to_pixel(start.x_m, start.y_m), start.heading_rad, kBlack);
  }
}

}  // namespace

MapSheet lay_out_map(const MapPicture& picture) {
  const MapExtent extent = extent_of(picture);
  const Axis x = {picture.to_the_right + " [m]", range_of(extent.x_m)};
  const Axis y = {picture.upwards + " [m]", range_of(extent.y_m)};
  const double legend_px = legend_width_px(Canvas(1, 1), legend_of(picture));
  const double plot_width_px = kWidth_px - kMapLeft_px - legend_px - 2.0 * kGap_px;
  const int height_px = height_for(x.range, y.range, plot_width_px);
  const Box plot = {kMapLeft_px, kMapTop_px, plot_width_px, height_px - kMapTop_px - kMapBottom_px};
  return {kWidth_px, height_px, Axes::with_equal_scale(x, y, plot)};
}

std::string draw_map_picture(const MapPicture& picture) {
  const auto [width_px, height_px, axes] = lay_out_map(picture);
  const Box& plot = axes.plot();
  Canvas canvas(width_px, height_px);
  axes.draw(canvas);
  canvas.clip_to(plot);
  draw_contents(canvas, axes, picture);
  canvas.clip_to({});
  draw_legend(canvas, {plot.left_px + plot.width_px + kGap_px, kMapTop_px}, legend_of(picture));
  canvas.write({kMapLeft_px, 0.5 * kMapTop_px}, picture.title, {.size_px = 15.0, .bold = true});
  return canvas.png();
}

}  // namespace stereobench::harness
