/// Golden frames that are painted by hand: four balls before a wall, a column, the floor and nothing.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "harness/golden/golden_frame.h"
#include "renderer/surfaces/primitives.h"

namespace stereobench::harness {

struct PaintedBall {
  Eigen::Vector2d centre_px;
  double radius_px;
  cv::Vec3d colour;
};

inline const std::array<PaintedBall, 4> kPaintedBalls = {{{{30.3, 40.2}, 9.0, {200.0, 30.0, 20.0}},
                                                          {{80.0, 35.5}, 12.5, {20.0, 180.0, 40.0}},
                                                          {{120.6, 60.1}, 5.0, {30.0, 40.0, 220.0}},
                                                          {{60.2, 80.7}, 15.0, {180.0, 170.0, 20.0}}}};

constexpr int kPaintedWall = renderer::kFirstWallPrimitive;
constexpr int kPaintedMesh = kPaintedWall + 1;

/// What lies behind the balls: sky, a wall below it, a column in the middle, and the floor at the bottom.
inline int surface_behind(int u, int v) {
  if (v < 10) return renderer::kNoPrimitive;
  if (u > 95 && u < 105) return kPaintedMesh;
  return v < 70 ? kPaintedWall : renderer::kFloorPrimitive;
}

/// Paints a picture of 160 x 110 pixels; edges are the mean of 16 x 16 samples a pixel.
/// @param shift_px of each ball
inline GoldenPicture painted_picture(const std::array<Eigen::Vector2d, 4>& shift_px) {
  constexpr int kSamples = 16;
  GoldenPicture picture{.seen_sha256 = std::string(64, '0'),
                        .colour = cv::Mat(110, 160, CV_8UC3),
                        .shown = cv::Mat(110, 160, CV_16UC1)};
  for (int v = 0; v < picture.shown.rows; ++v) {
    for (int u = 0; u < picture.shown.cols; ++u) {
      cv::Vec3d light = cv::Vec3d::all(100.0 + 20.0 * std::sin(0.3 * u) * std::sin(0.2 * v));
      int surface = surface_behind(u, v);
      for (std::size_t i = 0; i < kPaintedBalls.size(); ++i) {
        const PaintedBall& ball = kPaintedBalls[i];
        const Eigen::Vector2d centre = ball.centre_px + shift_px[i];
        const auto is_in = [&](double x, double y) {
          return (Eigen::Vector2d(x, y) - centre).norm() < ball.radius_px;
        };
        int inside = 0;
        for (int k = 0; k < kSamples * kSamples; ++k)
          inside +=
              is_in(u - 0.5 + (k % kSamples + 0.5) / kSamples, v - 0.5 + (k / kSamples + 0.5) / kSamples);
        const double covered = static_cast<double>(inside) / (kSamples * kSamples);
        light = light * (1.0 - covered) + ball.colour * covered;
        if (is_in(u, v)) surface = static_cast<int>(i) + 1;
      }
      for (int channel = 0; channel < 3; ++channel)
        picture.colour.at<cv::Vec3b>(v, u)[channel] = static_cast<std::uint8_t>(std::lround(light[channel]));
      picture.shown.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(surface);
    }
  }
  return picture;
}

/// @param shift_px of the balls in the left picture
inline GoldenFrame painted_frame(const std::array<Eigen::Vector2d, 4>& shift_px = {
                                     Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                     Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}) {
  static const GoldenPicture still = painted_picture(
      {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()});
  GoldenFrame frame{.name = {3, 12}, .smaller = 4, .first_mesh = kPaintedMesh};
  frame.left = painted_picture(shift_px);
  frame.right = {still.seen_sha256, still.colour.clone(), still.shown.clone()};
  return frame;
}

/// Changes what the detector sees, as any change of light does.
inline void see_something_else(GoldenPicture& picture) {
  picture.seen_sha256 = std::string(64, '1');
}

}  // namespace stereobench::harness
