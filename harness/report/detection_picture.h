/// What the observer saw, drawn on what it looked at.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "vision/outline/outline_fit.h"
#include "vision/types.h"
#include "worlds/camera_sensor.h"

namespace stereobench::harness {

/// The pair as screens show it rightly: light that a camera stores as it is becomes sRGB (IEC 61966-2-1).
/// @param pair two CV_8UC3 images, as `camera` stores them
vision::StereoPair for_display(const vision::StereoPair& pair, const worlds::CameraSensor& camera);

/// What truth says of a ball in a pair.
struct TrueBall {
  int id = 0;  ///< of its pixels: World::balls[id - 1]
  std::string label;
  bool is_missed = false;  ///< drawn in another colour
};

/// Truth that is drawn below what was observed.
struct DrawnTruth {
  cv::Mat left_ids, right_ids;  ///< CV_8UC1, which ball each pixel shows, of the pictures' size
  std::vector<TrueBall> balls;
};

/// Draws the observed balls' outlines, centres, colour index and range on both cameras' pictures, side by
/// side. Observations that are not to be trusted are dashed and say why.
/// @param pair two CV_8UC3 images of one size, not empty
/// @param max_width_px the picture is scaled down to this width when it is wider, >= 64
/// @param truth the borders of its balls' pixels are drawn, too
/// @return the bytes of a PNG file
/// @throws std::invalid_argument when the images are not such a pair
std::string draw_detection_picture(const vision::StereoPair& pair,
                                   std::span<const vision::BallObservation> observations,
                                   int max_width_px = 1600, const DrawnTruth& truth = {});

/// The same for a single picture: outlines with their colour and radius.
/// @throws std::invalid_argument when it is no CV_8UC3 picture
/// @param names of colours, in place of their numbers
std::string draw_outline_picture(const cv::Mat& picture, std::span<const vision::MeasuredOutline> outlines,
                                 int max_width_px = 1600, std::span<const std::string> names = {});

}  // namespace stereobench::harness
