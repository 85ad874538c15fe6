#include "harness/rig_calibration/rig_picture.h"

#include <algorithm>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/report/canvas.h"
#include "harness/rig_calibration/rectified_rig.h"
#include "vision/camera/rectify.h"

namespace stereobench::harness {
namespace {

constexpr int kWidth_px = 1400;
constexpr int kChartHeight_px = 260;
constexpr int kRowLines = 16;
constexpr Colour kRow = {0.2, 0.9, 0.4, 0.8};
constexpr Colour kCorner = {1.0, 0.35, 0.1, 1.0};
constexpr std::array<Colour, 3> kBars = {
    {{0.2, 0.4, 0.8, 1.0}, {0.85, 0.45, 0.1, 1.0}, {0.2, 0.6, 0.3, 1.0}}};
constexpr std::array<const char*, 3> kBarNames = {"left", "right", "rows between the cameras"};

/// Both cameras' rectified pictures side by side, above white paper for the chart.
cv::Mat sheet_of(const vision::StereoPair& rectified, double scale) {
  cv::Mat both;
  cv::hconcat(rectified.left, rectified.right, both);
  cv::resize(both, both, {kWidth_px, static_cast<int>(scale * rectified.left.rows)}, 0.0, 0.0,
             cv::INTER_AREA);
  cv::copyMakeBorder(both, both, 0, kChartHeight_px, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(255));
  return both;
}

void draw_rows(Canvas& canvas, double height_px) {
  for (int i = 1; i < kRowLines; ++i) {
    const double row = height_px * i / kRowLines;
    const std::vector<Point> line = {{0.0, row}, {double{kWidth_px}, row}};
    canvas.draw_line(line, {kRow, 1.0});
  }
}

void draw_corners(Canvas& canvas, const BoardCalibration& calibration, const BoardView& view,
                  const vision::Rectification& rectification, double scale) {
  const vision::Intrinsics& drawn = rectification.rig().intrinsics;
  const vision::Intrinsics& plain = calibration.rig.rig.intrinsics;
  for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight}) {
    const double left_px = side == vision::Side::kLeft ? 0.0 : 0.5 * kWidth_px;
    for (const Eigen::Vector2d& corner : view.corners_px[static_cast<std::size_t>(side)]) {
      const auto at = rectified_px(calibration.rig, corner, side);
      if (!at) continue;
      const double x = left_px + scale * (at->x() - plain.cx_px + drawn.cx_px + 0.5);
      const double y = scale * (at->y() - plain.cy_px + drawn.cy_px + 0.5);
      const std::vector<Point> across = {{x - 3.0, y}, {x + 3.0, y}};
      const std::vector<Point> up = {{x, y - 3.0}, {x, y + 3.0}};
      canvas.draw_line(across, {kCorner, 1.2});
      canvas.draw_line(up, {kCorner, 1.2});
    }
  }
}

void draw_bar(Canvas& canvas, const Box& bar, const Colour& colour) {
  const double right = bar.left_px + bar.width_px;
  const double bottom = bar.top_px + bar.height_px;
  const std::vector<Point> corners = {
      {bar.left_px, bar.top_px}, {right, bar.top_px}, {right, bottom}, {bar.left_px, bottom}};
  canvas.fill(corners, colour);
}

void draw_legend(Canvas& canvas, double top_px, const std::string& title) {
  canvas.write({20.0, top_px + 18.0}, title, {.size_px = 14.0, .bold = true});
  double x = kWidth_px - 20.0;
  for (std::size_t i = kBars.size(); i-- > 0;) {
    x -= canvas.text_width_px(kBarNames[i], {});
    canvas.write({x, top_px + 18.0}, kBarNames[i], {});
    x -= 18.0;
    draw_bar(canvas, {x, top_px + 12.0, 12.0, 12.0}, kBars[i]);
    x -= 18.0;
  }
}

/// Three bars a view: each camera's error, and that of rows.
void draw_errors(Canvas& canvas, const BoardCalibration& calibration, double top_px) {
  const double base_px = top_px + kChartHeight_px - 40.0;
  const double tallest_px = kChartHeight_px - 90.0;
  double largest = 1e-9;
  for (const ViewOutcome& view : calibration.outcomes)
    if (view.dropped.empty())
      largest = std::max({largest, calibration.fit.view_rms_px[view.index][0],
                          calibration.fit.view_rms_px[view.index][1], view.row_rms_px});
  const double slot_px = (kWidth_px - 80.0) / static_cast<double>(calibration.outcomes.size());
  for (std::size_t i = 0; i < calibration.outcomes.size(); ++i) {
    const ViewOutcome& view = calibration.outcomes[i];
    const double left_px = 60.0 + slot_px * static_cast<double>(i);
    const std::string label = view.dropped.empty() ? view.name : view.name + " (dropped)";
    if (canvas.text_width_px(label, {}) < slot_px)
      canvas.write({left_px + 0.5 * slot_px, base_px + 16.0}, label, {.align_x = 0.5});
    if (!view.dropped.empty()) continue;
    const auto& rms = calibration.fit.view_rms_px[view.index];
    const std::array<double, 3> values = {rms[0], rms[1], view.row_rms_px};
    for (std::size_t bar = 0; bar < values.size(); ++bar) {
      const double height_px = tallest_px * values[bar] / largest;
      const double x = left_px + slot_px * (0.15 + 0.24 * static_cast<double>(bar));
      draw_bar(canvas, {x, base_px - height_px, 0.2 * slot_px, height_px}, kBars[bar]);
    }
  }
  const std::vector<Point> axis = {{60.0, base_px}, {kWidth_px - 20.0, base_px}};
  const std::vector<Point> most = {{60.0, base_px - tallest_px}, {kWidth_px - 20.0, base_px - tallest_px}};
  canvas.draw_line(axis, {.width_px = 1.0});
  canvas.draw_line(most, {{0.6, 0.6, 0.6, 1.0}, 1.0, Dash::kDotted});
  canvas.write({54.0, base_px}, "0", {.align_x = 1.0});
  canvas.write({54.0, base_px - tallest_px}, fmt::format("{:.2f}", largest), {.align_x = 1.0});
}

}  // namespace

std::string draw_rig_picture(const BoardCalibration& calibration, std::size_t view,
                             const vision::StereoPair& pair) {
  const vision::CameraPair cameras =
      calibration.rig.cameras ? *calibration.rig.cameras : vision::cameras_of(calibration.rig.rig);
  const vision::Rectification rectification(calibration.rig.rig, cameras);
  const vision::StereoPair rectified = rectification.apply(pair);
  const double scale = 0.5 * kWidth_px / rectified.left.cols;
  const cv::Mat sheet = sheet_of(rectified, scale);
  const double height_px = sheet.rows - kChartHeight_px;
  Canvas canvas(sheet);
  draw_rows(canvas, height_px);
  draw_corners(canvas, calibration, calibration.used[view], rectification, scale);
  draw_legend(canvas, height_px,
              fmt::format("View {}, rectified. Errors by view, rms in pixels: {:.3f} overall, rows {:.3f}",
                          calibration.used[view].name, calibration.fit.rms_px, calibration.row_rms_px));
  draw_errors(canvas, calibration, height_px);
  return canvas.png();
}

}  // namespace stereobench::harness
