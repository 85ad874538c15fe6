#include "renderer/truth/ball_truth.h"

#include <algorithm>
#include <cmath>

namespace stereobench::renderer {
namespace {

/// How many whole numbers lie in [low, high], and the first of them.
struct WholeNumbers {
  int first;
  int count;
};

WholeNumbers whole_numbers(double low, double high) {
  const int first = static_cast<int>(std::ceil(low));
  return {first, std::max(0, static_cast<int>(std::floor(high)) - first + 1)};
}

void add(PixelSet& set, const cv::Rect& run) {
  if (run.empty()) return;
  set.count += run.area();
  set.box |= run;
}

/// The equation q' S q = 1 of an ellipse around its centre.
Eigen::Matrix2d shape_of(const vision::OutlineEllipse& ellipse) {
  const Eigen::Vector2d major(std::cos(ellipse.angle_rad), std::sin(ellipse.angle_rad));
  const double a = 1.0 / (ellipse.semi_major_px * ellipse.semi_major_px);
  const double b = 1.0 / (ellipse.semi_minor_px * ellipse.semi_minor_px);
  return b * Eigen::Matrix2d::Identity() + (a - b) * major * major.transpose();
}

/// Calls a function with the pixels of each row whose centres lie within an outline.
template <class Take>
void for_runs_within(const vision::OutlineEllipse& outline, const Take& take) {
  const Eigen::Matrix2d shape = shape_of(outline);
  const double reach = outline.half_extent_px().y();
  const WholeNumbers rows = whole_numbers(outline.centre_px.y() - reach, outline.centre_px.y() + reach);
  for (int row = rows.first; row < rows.first + rows.count; ++row) {
    const double dy = row - outline.centre_px.y();
    const double lean = -shape(0, 1) * dy;
    const double spare = lean * lean - shape(0, 0) * (shape(1, 1) * dy * dy - 1.0);
    if (spare < 0.0) continue;
    const double middle = outline.centre_px.x() + lean / shape(0, 0);
    const double half = std::sqrt(spare) / shape(0, 0);
    const WholeNumbers columns = whole_numbers(middle - half, middle + half);
    take(cv::Rect(columns.first, row, columns.count, 1));
  }
}

BallTruth truth_of(const worlds::Ball& ball, const Eigen::Vector3d& in_camera,
                   const vision::Intrinsics& camera) {
  BallTruth truth;
  truth.centre_in_camera_m = in_camera;
  truth.centre_px = vision::project(camera, in_camera);
  truth.outline = *vision::sphere_outline(camera, in_camera, ball.radius_m);
  return truth;
}

bool meets_picture(const vision::Intrinsics& camera, const vision::OutlineEllipse& outline) {
  const Eigen::Vector2d low = outline.centre_px - outline.half_extent_px();
  const Eigen::Vector2d high = outline.centre_px + outline.half_extent_px();
  return high.minCoeff() > -0.5 && low.x() < camera.width_px - 0.5 && low.y() < camera.height_px - 0.5;
}

}  // namespace

std::array<PixelSet, 256> pixels_by_id(const cv::Mat& ball_id) {
  std::array<PixelSet, 256> sets{};
  for (int row = 0; row < ball_id.rows; ++row) {
    const auto* ids = ball_id.ptr<std::uint8_t>(row);
    for (int begin = 0, end = 0; begin < ball_id.cols; begin = end) {
      while (end < ball_id.cols && ids[end] == ids[begin]) ++end;
      add(sets[ids[begin]], {begin, row, end - begin, 1});
    }
  }
  return sets;
}

PixelSet pixels_within(const vision::OutlineEllipse& outline) {
  PixelSet set;
  for_runs_within(outline, [&](const cv::Rect& run) { add(set, run); });
  return set;
}

cv::Mat mask_within(const vision::OutlineEllipse& outline, const cv::Size& size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  for_runs_within(outline, [&](const cv::Rect& run) { mask(run & cv::Rect({0, 0}, size)).setTo(255); });
  return mask;
}

std::vector<BallTruth> counted(std::vector<BallTruth> truths, const vision::Intrinsics& camera,
                               const cv::Mat& ball_id) {
  const std::array<PixelSet, 256> seen = pixels_by_id(ball_id);
  std::erase_if(truths, [&](const BallTruth& truth) { return !meets_picture(camera, truth.outline); });
  for (BallTruth& truth : truths) {
    const PixelSet whole = pixels_within(truth.outline);
    const PixelSet& visible = seen[static_cast<std::size_t>(truth.ball) + 1];
    truth.px_count_all = whole.count;
    truth.bbox_obj = whole.box;
    truth.truncated = !vision::lies_inside(camera, truth.outline);
    truth.px_count_visib = visible.count;
    truth.bbox_visib = visible.box;
    truth.visib_fract =
        whole.count > 0 ? static_cast<double>(visible.count) / static_cast<double>(whole.count) : 0.0;
  }
  return truths;
}

std::vector<BallTruth> ball_truths(const worlds::World& world, const CameraView& view,
                                   const cv::Mat& ball_id) {
  std::vector<BallTruth> truths;
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const worlds::Ball& ball = world.balls[i];
    const Eigen::Vector3d in_camera = view.camera_from_world * ball.centre_m;
    if (!(in_camera.z() - ball.radius_m > kNear_m)) continue;  // not drawn (renderer.h)
    truths.push_back(truth_of(ball, in_camera, view.intrinsics));
    truths.back().ball = static_cast<int>(i);
  }
  return counted(std::move(truths), view.intrinsics, ball_id);
}

}  // namespace stereobench::renderer
