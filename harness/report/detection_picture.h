/// What the observer saw, drawn on what it looked at.
#pragma once

#include <span>
#include <string>

#include "vision/types.h"

namespace stereobench::harness {

/// Draws the observed balls' outlines, centres, colour index and range on both eyes' pictures, side by side.
/// Observations that are not to be trusted are dashed and say why.
/// @param pair two CV_8UC3 images of one size, not empty
/// @param max_width_px the picture is scaled down to this width when it is wider, >= 64
/// @return the bytes of a PNG file
/// @throws std::invalid_argument when the images are not such a pair
std::string draw_detection_picture(const vision::StereoPair& pair,
                                   std::span<const vision::BallObservation> observations,
                                   int max_width_px = 1600);

}  // namespace stereobench::harness
