/// A sheet to draw on: anti-aliased lines, areas and text, given back as a PNG.
///
/// The only place that knows Cairo. Pixels: x right, y down, (0, 0) is the sheet's top-left corner.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <opencv2/core.hpp>

struct _cairo;
struct _cairo_surface;

namespace stereobench::harness {

struct Point {
  double x_px = 0.0;
  double y_px = 0.0;
};

struct Box {
  double left_px = 0.0;
  double top_px = 0.0;
  double width_px = 0.0;
  double height_px = 0.0;
};

/// Each in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

enum class Dash { kSolid, kDashed, kDotted };

struct Stroke {
  Colour colour = {};
  double width_px = 1.5;
  Dash dash = Dash::kSolid;
};

struct TextStyle {
  double size_px = 13.0;
  Colour colour = {0.13, 0.13, 0.13, 1.0};
  double align_x = 0.0;  ///< 0: the text begins at the point, 0.5: is centred on it, 1: ends there
  bool bold = false;
  bool upwards = false;  ///< reads from bottom to top
};

/// Owns one drawing surface.
class Canvas {
 public:
  /// A white sheet. @throws std::invalid_argument unless both sides are in 1..16384
  Canvas(int width_px, int height_px);
  /// A sheet that begins as a picture. @param bgr CV_8UC3, not empty
  explicit Canvas(const cv::Mat& bgr);

  /// Draws a line through the points; it is interrupted at points that are not finite.
  void draw_line(std::span<const Point> points, const Stroke& stroke);
  /// Fills the polygon; nothing is drawn when a corner is not finite.
  void fill(std::span<const Point> corners, const Colour& colour);
  /// Writes text, vertically centred on the point (horizontally when it reads upwards).
  void write(const Point& at, const std::string& text, const TextStyle& style);
  /// @return how long the text is, in pixels
  double text_width_px(const std::string& text, const TextStyle& style) const;
  /// Restricts what is drawn from now on to a box, or to nothing but the sheet.
  void clip_to(const std::optional<Box>& box);
  /// @return the sheet as the bytes of a PNG file
  std::string png() const;

 private:
  std::unique_ptr<_cairo_surface, void (*)(_cairo_surface*)> surface_;
  std::unique_ptr<_cairo, void (*)(_cairo*)> context_;
};

}  // namespace stereobench::harness
