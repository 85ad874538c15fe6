/// A ball as a fragment shader wants it: numbers that keep their digits in single precision.
#pragma once

#include <array>
#include <optional>

#include "renderer/camera/camera_view.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// Everything a pixel needs to know about a ball, relative to the centre of the ball's outline, so that no
/// large numbers are subtracted per pixel. With q the pixel's offset from the ellipse's centre (px), the line
/// of sight p(q) meets the sphere where the discriminant (p . c)^2 - |p|^2 (|c|^2 - R^2) = peak (1 - q' S q)
/// > 0.
struct BallOutline {
  std::array<float, 4>
      centre;  ///< of the ellipse in the framebuffer, in gl_FragCoord's convention: whole, rest
  std::array<float, 4> shape;  ///< S as (xx, xy, yy), px^-2, and the peak of the discriminant, m^2
  std::array<float, 4>
      ray;  ///< line of sight of the ellipse's centre (x, y; z = 1), p . c there, 1 / focal_px
  std::array<float, 4> ball;    ///< centre in the camera frame, m, and 1 / R
  std::array<float, 4> colour;  ///< red, green, blue in [0, 1], identity / 255
  std::array<float, 4>
      bounds;  ///< of the outline with a margin, device coordinates: left, top, right, bottom
};

/// The outline of a ball in a camera.
/// @param identity 1..254, what is written into the picture's ids
/// @return empty when no pixel can see the ball, or when it reaches behind the near plane
std::optional<BallOutline> ball_outline(const CameraView& view, const worlds::Ball& ball, int identity);

}  // namespace stereobench::renderer
