#include "renderer/balls/ball_veil.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>

namespace stereobench::renderer {
namespace {

/// The area of a pixel on the inner side of an edge: covered_area of ball_shader.h.
double covered_area(const Eigen::Vector2d& normal, double outside, double curvature) {
  const double a = normal.cwiseAbs().maxCoeff(), b = std::max(normal.cwiseAbs().minCoeff(), 1e-6);
  const double left = std::max(0.5 * (a + b) - std::abs(outside), 0.0);
  const bool cuts_corner = left < b;
  const double chord = cuts_corner ? left / (a * b) : 1.0 / a;
  const double middle = cuts_corner ? 0.5 * (a - b) * (1.0 - left * (a + b) / (a * b)) : b * outside / a;
  const double bent = outside + 0.5 * curvature * (chord * chord / 12.0 + middle * middle);
  const double corner = std::max(0.5 * (a + b) - std::abs(bent), 0.0);
  const double beyond = corner < b ? 0.5 * corner * corner / (a * b) : 0.5 - std::abs(bent) / a;
  return bent > 0.0 ? beyond : 1.0 - beyond;
}

/// From the middle of the ball's outline to a pixel's centre, px.
Eigen::Vector2d offset(const BallOutline& outline, const cv::Point& pixel) {
  const auto& centre = outline.centre;
  return {pixel.x + 0.5 - double{centre[0]} - double{centre[2]},
          pixel.y + 0.5 - double{centre[1]} - double{centre[3]}};
}

/// The pixels of the camera's whole picture that the outline's bounds touch.
cv::Rect box_of(const BallOutline& outline, const vision::Intrinsics& camera) {
  const auto place = [](float device, int size_px) { return (double{device} + 1.0) / 2.0 * size_px; };
  const auto& bounds = outline.bounds;
  const cv::Point first(static_cast<int>(std::floor(place(bounds[0], camera.width_px))),
                        static_cast<int>(std::floor(place(bounds[1], camera.height_px))));
  const cv::Point last(static_cast<int>(std::ceil(place(bounds[2], camera.width_px))),
                       static_cast<int>(std::ceil(place(bounds[3], camera.height_px))));
  return {first, last};
}

}  // namespace

BallVeil::BallVeil(const CameraView& view, std::vector<BallOutline> outlines, const cv::Range& rows)
    : outlines_(std::move(outlines)), origin_(view.first_column_px, rows.start) {
  const cv::Rect picture(0, 0, view.intrinsics.width_px, rows.size());
  for (const BallOutline& outline : outlines_)
    boxes_.push_back((box_of(outline, view.intrinsics) - cv::Point(0, rows.start)) & picture);
}

float BallVeil::light_left(const cv::Point& pixel, double inverse_depth) const {
  double left = 1.0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].contains(pixel)) continue;
    const BallCover ball = cover(outlines_[i], pixel + origin_);
    if (ball.inverse_depth > inverse_depth) left *= 1.0 - ball.share;
  }
  return static_cast<float>(left);
}

BallCover cover(const BallOutline& outline, const cv::Point& pixel) {
  const auto& [xx, xy, yy, peak_m2] = outline.shape;
  const auto& [ray_x, ray_y, ray_along, per_px] = outline.ray;
  const Eigen::Vector2d q = offset(outline, pixel);
  const Eigen::Vector2d gradient(double{xx} * q.x() + double{xy} * q.y(),
                                 double{xy} * q.x() + double{yy} * q.y());
  const double inside = 1.0 - q.dot(gradient), level = std::sqrt(1.0 - inside);
  const double steepness = std::max(gradient.norm(), 1e-9);
  const Eigen::Vector2d normal = gradient / steepness;
  const double curvature =
      level / steepness *
      (double{xx} * normal.y() * normal.y() - 2.0 * double{xy} * normal.x() * normal.y() +
       double{yy} * normal.x() * normal.x());
  const double outside = (level - 1.0) * level / steepness;
  const Eigen::Vector3d sight(double{ray_x} + q.x() * double{per_px}, double{ray_y} + q.y() * double{per_px},
                              1.0);
  const double along = double{ray_along} +
                       double{per_px} * (q.x() * double{outline.ball[0]} + q.y() * double{outline.ball[1]});
  const double root = std::sqrt(std::max(double{peak_m2} * inside, 0.0));
  return {covered_area(normal, outside, curvature), sight.squaredNorm() / (along - root)};
}

}  // namespace stereobench::renderer
