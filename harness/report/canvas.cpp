#include "harness/report/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <cairo.h>

#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

constexpr int kMaxSide_px = 16384;

cairo_surface_t* new_surface(int width_px, int height_px) {
  if (width_px < 1 || height_px < 1 || width_px > kMaxSide_px || height_px > kMaxSide_px) {
    throw std::invalid_argument("a canvas has 1 to 16384 pixels a side");
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px);
}

/// Cairo counts in 24.8 fixed point: what lies farther out than this would wrap around.
double within_reach(double pixel) {
  return std::clamp(pixel, -1e6, 1e6);
}

bool is_finite(const Point& point) {
  return std::isfinite(point.x_px) && std::isfinite(point.y_px);
}

void set_colour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

void set_stroke(cairo_t* context, const Stroke& stroke) {
  set_colour(context, stroke.colour);
  cairo_set_line_width(context, stroke.width_px);
  const double gap = stroke.width_px + 3.0;
  const double dash = stroke.dash == Dash::kDashed ? 4.0 * stroke.width_px + 2.0 : stroke.width_px;
  const std::array<double, 2> pattern = {dash, gap};
  cairo_set_dash(context, pattern.data(), stroke.dash == Dash::kSolid ? 0 : 2, 0.0);
}

void select_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size_px);
}

cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Canvas::Canvas(int width_px, int height_px)
    : surface_(new_surface(width_px, height_px), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
  // Grey anti-aliasing and unhinted text look the same whatever the desktop's font settings are.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgb(context_.get(), 1.0, 1.0, 1.0);
  cairo_paint(context_.get());
}

Canvas::Canvas(const cv::Mat& bgr) : Canvas(bgr.cols, bgr.rows) {
  if (bgr.type() != CV_8UC3) {
    throw std::invalid_argument("a canvas begins as an 8-bit picture of three channels");
  }
  cairo_surface_flush(surface_.get());
  // RGB24 keeps each pixel in a native 32-bit word; on little-endian machines its bytes are B, G, R, unused.
  cv::Mat pixels(bgr.rows, bgr.cols, CV_8UC4, cairo_image_surface_get_data(surface_.get()),
                 static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get())));
  for (int row = 0; row < bgr.rows; ++row) {
    const cv::Vec3b* source = bgr.ptr<cv::Vec3b>(row);
    std::transform(source, source + bgr.cols, pixels.ptr<cv::Vec4b>(row),
                   [](const cv::Vec3b& p) { return cv::Vec4b(p[0], p[1], p[2], 255); });
  }
  cairo_surface_mark_dirty(surface_.get());
}

void Canvas::draw_line(std::span<const Point> points, const Stroke& stroke) {
  cairo_t* context = context_.get();
  cairo_new_path(context);
  bool interrupted = true;
  for (const Point& point : points) {
    if (is_finite(point)) {
      const auto continue_to = interrupted ? cairo_move_to : cairo_line_to;
      continue_to(context, within_reach(point.x_px), within_reach(point.y_px));
    }
    interrupted = !is_finite(point);
  }
  set_stroke(context, stroke);
  cairo_stroke(context);
}

void Canvas::fill(std::span<const Point> corners, const Colour& colour) {
  if (!std::all_of(corners.begin(), corners.end(), is_finite)) return;
  cairo_t* context = context_.get();
  cairo_new_path(context);  // text leaves a current point behind
  for (const Point& corner : corners) {
    cairo_line_to(context, within_reach(corner.x_px), within_reach(corner.y_px));
  }
  cairo_close_path(context);
  set_colour(context, colour);
  cairo_fill(context);
}

void Canvas::write(const Point& at, const std::string& text, const TextStyle& style) {
  if (!is_finite(at)) return;
  cairo_t* context = context_.get();
  cairo_save(context);
  cairo_translate(context, at.x_px, at.y_px);
  if (style.upwards) cairo_rotate(context, -0.5 * slam::kPi);
  select_font(context, style);
  set_colour(context, style.colour);
  // The middle of DejaVu's lower-case and capital letters lies about 0.36 em above the baseline.
  cairo_move_to(context, -style.align_x * text_width_px(text, style), 0.36 * style.size_px);
  cairo_show_text(context, text.c_str());
  cairo_restore(context);
}

double Canvas::text_width_px(const std::string& text, const TextStyle& style) const {
  cairo_t* context = context_.get();
  cairo_save(context);
  select_font(context, style);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_restore(context);
  return extents.x_advance;
}

void Canvas::clip_to(const std::optional<Box>& box) {
  cairo_reset_clip(context_.get());
  if (!box) return;
  cairo_rectangle(context_.get(), box->left_px, box->top_px, box->width_px, box->height_px);
  cairo_clip(context_.get());
}

std::string Canvas::png() const {
  std::string bytes;
  cairo_status_t status = cairo_status(context_.get());  // e.g. after text that is not UTF-8
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(surface_.get(), append_bytes, &bytes);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("cannot draw a picture: ") + cairo_status_to_string(status));
  }
  return bytes;
}

}  // namespace stereobench::harness
