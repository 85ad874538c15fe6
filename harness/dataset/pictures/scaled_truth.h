/// The truth of a picture of fewer pixels: what the centre of each of its pixels sees.
///
/// Where N is odd, a pixel's centre is that of one of the camera's pixels. Where it is even, it is the corner
/// of four. Which ball is seen there is decided by the ray and the balls that the four pixels show, exactly.
/// Inverse depth is linear on a plane: it is the mean of two pixels on opposite sides, where both show no
/// ball and do not differ by more than a pixel of disparity. Elsewhere the nearest of the pixels counts.
#pragma once

#include <opencv2/core.hpp>

#include "renderer/camera/camera_view.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/pixel_truth.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A camera's look with fewer pixels.
struct ScaledLook {
  int divide = 1;
  renderer::CameraView view;  ///< of the fewer pixels
  double baseline_m = 0.0;    ///< by which depths are compared
};

/// What the centres of a scaled picture's pixels see.
struct ScaledTruth {
  cv::Mat ball_id;  ///< CV_8UC1
  cv::Mat depth_m;  ///< CV_32FC1, planar Z, +inf = nothing
  cv::Mat from;     ///< CV_32SC2, column and row of the whole picture's pixel that sees the same thing
};

/// @param ball_id, depth_m of the whole picture @param world its balls
ScaledTruth scaled_truth(const cv::Mat& ball_id, const cv::Mat& depth_m, const ScaledLook& look,
                         const worlds::World& world);

/// Surface, range and normal of the same places. Ranges are those of the depths, normals of balls are exact,
/// others those of the pixel that the place is taken from.
renderer::PixelTruth scaled_pixels(const renderer::PixelTruth& whole, const ScaledTruth& truth,
                                   const ScaledLook& look, const worlds::World& world);

/// Where the places are in another look at the same world, by their depth; whether they are hidden there, the
/// pixel that they are taken from says.
/// @param to of the other picture, which is as small
renderer::Correspondence scaled_correspondence(const renderer::Correspondence& whole,
                                               const ScaledTruth& truth, const renderer::CameraView& from,
                                               const renderer::CameraView& to);

}  // namespace stereobench::harness
