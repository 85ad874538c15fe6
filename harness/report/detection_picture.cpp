#include "harness/report/detection_picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/report/canvas.h"
#include "renderer/camera/sensor_model.h"
#include "slam/math/angles.h"
#include "vision/observe.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::harness {
namespace {

constexpr Colour kLine = {1.0, 1.0, 1.0, 1.0};
constexpr Colour kShade = {0.0, 0.0, 0.0, 0.75};
constexpr Colour kTrue = {0.337, 0.906, 0.914, 1.0};
constexpr Colour kMissed = {1.0, 0.25, 0.1, 1.0};

void check(const vision::StereoPair& pair, int max_width_px) {
  const bool alike = !pair.left.empty() && pair.left.size() == pair.right.size();
  if (!alike || pair.left.type() != CV_8UC3 || pair.right.type() != CV_8UC3) {
    throw std::invalid_argument("detections are drawn on two 8-bit BGR images of one size");
  }
  if (max_width_px < 64) throw std::invalid_argument("a detection picture is at least 64 pixels wide");
}

cv::Mat behind_drawing(cv::Mat picture, double scale) {
  if (scale < 1.0) cv::resize(picture, picture, {}, scale, scale, cv::INTER_AREA);
  // Five bits a channel look the same behind the drawing and leave out most of the noise, which PNG cannot
  // pack.
  cv::bitwise_and(picture, cv::Scalar::all(0xF8), picture);
  return picture + cv::Scalar::all(4);
}

cv::Mat side_by_side(const vision::StereoPair& pair, double scale) {
  cv::Mat both;
  cv::hconcat(pair.left, pair.right, both);
  return behind_drawing(both, scale);
}

/// White on a black line is seen on every background.
void draw_contrasting(Canvas& canvas, std::span<const Point> points, Dash dash) {
  canvas.draw_line(points, {kShade, 3.6, Dash::kSolid});
  canvas.draw_line(points, {kLine, 1.6, dash});
}

void draw_outline(Canvas& canvas, const Point& centre, double radius_px, Dash dash) {
  constexpr int kCorners = 72;
  std::vector<Point> outline;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * slam::kPi * i / kCorners;
    outline.push_back({centre.x_px + radius_px * std::cos(angle), centre.y_px + radius_px * std::sin(angle)});
  }
  draw_contrasting(canvas, outline, dash);
}

void draw_plus(Canvas& canvas, const Point& at, double arm_px) {
  const std::vector<Point> across = {{at.x_px - arm_px, at.y_px}, {at.x_px + arm_px, at.y_px}};
  const std::vector<Point> up = {{at.x_px, at.y_px - arm_px}, {at.x_px, at.y_px + arm_px}};
  draw_contrasting(canvas, across, Dash::kSolid);
  draw_contrasting(canvas, up, Dash::kSolid);
}

std::string label_of(const vision::BallObservation& ball) {
  const std::string colour = ball.colour == slam::kUnknown ? "?" : fmt::format("{}", ball.colour);
  std::string label = fmt::format("{}: {:.2f} m", colour, ball.range_bearing.range_m);
  if (ball.truncated) label += " cut";
  if (ball.occluded) label += " hidden";
  return label;
}

bool overlap(const Box& a, const Box& b) {
  return a.left_px < b.left_px + b.width_px && b.left_px < a.left_px + a.width_px &&
         a.top_px < b.top_px + b.height_px && b.top_px < a.top_px + a.height_px;
}

/// Puts labels below their balls, farther down where another label is in the way, inside one camera's
/// picture.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Box& area) : area_(area) {}

  Box place(const Point& below, double width_px, double height_px) {
    Box box = {below.x_px - 0.5 * width_px, below.y_px, width_px, height_px};
    const double last_left_px = std::max(area_.left_px, area_.left_px + area_.width_px - width_px);
    box.left_px = std::clamp(box.left_px, area_.left_px, last_left_px);
    const double last_top_px = std::max(area_.top_px, area_.top_px + area_.height_px - height_px);
    box.top_px = std::clamp(box.top_px, area_.top_px, last_top_px);
    for (std::size_t tried = 0; tried <= taken_.size(); ++tried) {
      const auto hit =
          std::find_if(taken_.begin(), taken_.end(), [&](const Box& b) { return overlap(b, box); });
      if (hit == taken_.end()) break;
      box.top_px = std::min(hit->top_px + hit->height_px + 1.0, last_top_px);
    }
    taken_.push_back(box);
    return box;
  }

 private:
  Box area_;
  std::vector<Box> taken_;
};

void draw_label(Canvas& canvas, LabelPlacer& placer, const Point& below, const std::string& label,
                const Colour& colour = kLine) {
  const TextStyle style = {.size_px = 13.0, .colour = colour};
  const Box box = placer.place(below, canvas.text_width_px(label, style) + 8.0, 17.0);
  const double right_px = box.left_px + box.width_px;
  const double bottom_px = box.top_px + box.height_px;
  const std::vector<Point> corners = {
      {box.left_px, box.top_px}, {right_px, box.top_px}, {right_px, bottom_px}, {box.left_px, bottom_px}};
  canvas.fill(corners, kShade);
  canvas.write({box.left_px + 4.0, box.top_px + 0.5 * box.height_px}, label, style);
}

/// What is drawn of a ball in one camera's picture, in that picture's pixels.
struct Ring {
  Eigen::Vector2d centre_px;
  double radius_px;
  bool whole;
  std::string label;
};

std::vector<Ring> rings_of(std::span<const vision::BallObservation> observations, vision::Side side) {
  std::vector<Ring> rings;
  for (const vision::BallObservation& ball : observations) {
    const bool left = side == vision::Side::kLeft;
    rings.push_back({left ? ball.left_px : ball.right_px, left ? ball.left_radius_px : ball.right_radius_px,
                     ball.trusted(), label_of(ball)});
  }
  return rings;
}

std::vector<Ring> rings_of(std::span<const vision::MeasuredOutline> outlines,
                           std::span<const std::string> names) {
  std::vector<Ring> rings;
  for (const vision::MeasuredOutline& outline : outlines) {
    const bool cut = outline.outside_fraction > vision::kOutlineFit.most_hidden;
    const bool hidden = outline.hidden_fraction > vision::kOutlineFit.most_hidden;
    const auto colour = static_cast<std::size_t>(outline.colour);
    const std::string name = colour < names.size() ? names[colour] : fmt::format("{}", outline.colour);
    const std::string label = fmt::format("{}: {:.1f} px", name, outline.radius_px);
    rings.push_back({outline.centre_px, outline.radius_px, !cut && !hidden,
                     label + (cut ? " cut" : "") + (hidden ? " hidden" : "")});
  }
  return rings;
}

/// Draws the border of each true ball's pixels, and its label above.
/// @param scale pixels of the picture per pixel of the camera's image
void draw_truth(Canvas& canvas, const Box& box, double scale, const cv::Mat& ids,
                std::span<const TrueBall> balls) {
  canvas.clip_to(box);
  LabelPlacer placer(box);
  for (const TrueBall& ball : balls) {
    std::vector<std::vector<cv::Point>> borders;
    cv::findContours(ids == ball.id, borders, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    const Colour& colour = ball.is_missed ? kMissed : kTrue;
    Point top = {0.0, box.top_px + box.height_px};
    for (const std::vector<cv::Point>& border : borders) {
      std::vector<Point> line;
      for (const cv::Point& pixel : border)
        line.push_back({box.left_px + scale * (pixel.x + 0.5), box.top_px + scale * (pixel.y + 0.5)});
      line.push_back(line.front());
      canvas.draw_line(line, {colour, 1.4});
      for (const Point& point : line)
        if (point.y_px < top.y_px) top = point;
    }
    if (!borders.empty()) draw_label(canvas, placer, {top.x_px, top.y_px - 23.0}, ball.label, colour);
  }
  canvas.clip_to({});
}

/// Draws rings on a camera's part of the picture.
/// @param scale pixels of the picture per pixel of the camera's image
void draw_side(Canvas& canvas, const Box& box, double scale, std::span<const Ring> rings) {
  // Pixel (0, 0) of an image is the centre of its top-left pixel; a canvas begins at that pixel's corner.
  const auto centre_of = [&](const Ring& ring) {
    return Point{box.left_px + scale * (ring.centre_px.x() + 0.5),
                 box.top_px + scale * (ring.centre_px.y() + 0.5)};
  };
  canvas.clip_to(box);
  for (const Ring& ring : rings) {
    const double radius_px = scale * ring.radius_px;
    draw_outline(canvas, centre_of(ring), radius_px, ring.whole ? Dash::kSolid : Dash::kDashed);
    draw_plus(canvas, centre_of(ring), std::min(5.0, 0.5 * radius_px));
  }
  LabelPlacer placer(box);
  for (const Ring& ring : rings) {
    const Point centre = centre_of(ring);
    const Point below = {centre.x_px, centre.y_px + scale * ring.radius_px + 4.0};
    if (std::isfinite(below.x_px) && std::isfinite(below.y_px)) draw_label(canvas, placer, below, ring.label);
  }
  canvas.clip_to({});
}

}  // namespace

vision::StereoPair for_display(const vision::StereoPair& pair, const worlds::CameraSensor& camera) {
  if (camera.encoding != worlds::Encoding::kLinear) return pair;
  const worlds::CameraSensor screen{.encoding = worlds::Encoding::kSrgb};
  return {renderer::develop(pair.left, screen, 0, 0), renderer::develop(pair.right, screen, 0, 0)};
}

std::string draw_detection_picture(const vision::StereoPair& pair,
                                   std::span<const vision::BallObservation> observations, int max_width_px,
                                   const DrawnTruth& truth) {
  check(pair, max_width_px);
  const double scale = std::min(1.0, max_width_px / (2.0 * pair.left.cols));
  const cv::Mat both = side_by_side(pair, scale);
  Canvas canvas(both);
  const double side_width_px = 0.5 * both.cols;
  for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight}) {
    const double left_px = side == vision::Side::kLeft ? 0.0 : side_width_px;
    const Box box = {left_px, 0.0, side_width_px, static_cast<double>(both.rows)};
    const double drawn_scale = side_width_px / pair.left.cols;
    draw_side(canvas, box, drawn_scale, rings_of(observations, side));
    const bool is_left = side == vision::Side::kLeft;
    draw_truth(canvas, box, drawn_scale, is_left ? truth.left_ids : truth.right_ids, truth.balls);
  }
  const std::vector<Point> seam = {{side_width_px, 0.0}, {side_width_px, static_cast<double>(both.rows)}};
  canvas.draw_line(seam, {kLine, 2.0});
  return canvas.png();
}

std::string draw_outline_picture(const cv::Mat& picture, std::span<const vision::MeasuredOutline> outlines,
                                 int max_width_px, std::span<const std::string> names) {
  check({picture, picture}, max_width_px);
  const double scale = std::min(1.0, static_cast<double>(max_width_px) / picture.cols);
  const cv::Mat backdrop = behind_drawing(picture.clone(), scale);
  Canvas canvas(backdrop);
  const Box box = {0.0, 0.0, static_cast<double>(backdrop.cols), static_cast<double>(backdrop.rows)};
  draw_side(canvas, box, static_cast<double>(backdrop.cols) / picture.cols, rings_of(outlines, names));
  return canvas.png();
}

}  // namespace stereobench::harness
