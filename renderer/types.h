/// The vocabulary of the renderer: pictures and the truth behind each of their pixels.
#pragma once

#include <opencv2/core.hpp>

#include "vision/types.h"

namespace stereobench::renderer {

/// Which OpenGL draws. Those in software are the same rasteriser of the same Mesa: their pixels are equal.
enum class Backend {
  kOsmesa,   ///< Mesa's llvmpipe as a library
  kEgl,      ///< llvmpipe behind EGL, which outlives OSMesa: Mesa 25.1 dropped it
  kEglGpu,   ///< the first graphics card that EGL has
  kSoftware  ///< kOsmesa where this machine has its library, and kEgl else (drawn_by): the default everywhere
};

/// How finely linear light is told. Eight bits are as fine as what a camera stores that stores light as it
/// is; any other makes steps of them that show.
enum class LightDepth { kEightBits, kSixteenBits };

/// What one of 255 levels of light is in 16 bits.
inline constexpr int kStepsOfALevel = 257;

/// One camera's picture with its truth, all of the rig's width and height.
struct RenderedImage {
  /// BGR, linear light, anti-aliased, noise-free: CV_8UC3 in levels, or CV_16UC3 in steps of 1/257 level
  cv::Mat colour;
  cv::Mat ball_id;  ///< CV_8UC1, 0 = no ball, k = World::balls[k - 1] is what the pixel's centre sees
  cv::Mat depth_m;  ///< CV_32FC1, planar Z in the camera's frame of what the centre sees, +inf = nothing
};

struct StereoFrame {
  RenderedImage left;
  RenderedImage right;
};

}  // namespace stereobench::renderer
