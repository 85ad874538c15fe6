/// How fast pictures of a room can be made at best: one ray a pixel, eight pixels at a time, for the two
/// materials of one room and nothing else that a renderer must be able to do. Plain numbers only: it is
/// compiled for another CPU than everything else, which Eigen's and OpenCV's types would not survive.
#pragma once

#include <cstdint>
#include <span>

namespace stereobench {

/// A number that is linear in the picture: at_zero + per_column u + per_row v.
struct Linear {
  float at_zero, per_column, per_row;
};

/// A wall of bricks or a floor of tiles as a camera sees it.
struct LimitSurface {
  Linear inverse_depth;       ///< 1/m, as the next two over metres: of planes, all of it is linear
  Linear along, up;           ///< places on the surface over the depth
  float along_m[2], up_m[2];  ///< where it begins and ends
  float light;
  bool is_floor;
  int columns_px[2], rows_px[2];  ///< outside of them it is not seen
};

/// renderer::BallOutline, with places in the picture of the camera.
struct LimitBall {
  float centre_px[2], shape[4], ray[4], ball[4], rgb[3], id;
  int columns_px[2], rows_px[2];
};

struct LimitLight {
  float towards[3];  ///< camera frame
  float ambient, diffuse;
  std::uint8_t sky_bgr[3];
};

/// What is drawn, row by row without gaps; the width is a multiple of 64, the height one of 16.
struct LimitPicture {
  int width_px, height_px;
  std::uint8_t* bgr;
  std::uint8_t* id;
  float* depth_m;
};

/// Whether this CPU can run it.
bool can_cast_rays();

/// @param balls far ones first
void cast_rays(std::span<const LimitSurface> surfaces, std::span<const LimitBall> balls,
               const LimitLight& light, const LimitPicture& picture);

}  // namespace stereobench
