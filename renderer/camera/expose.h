/// What a camera makes of a perfect picture.
#pragma once

#include <cstdint>

#include "renderer/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// The light that a camera must be given, so that what it stores has no steps but its own. One that stores
/// light as it is, noise added or not, rounds it to whole levels anyway.
LightDepth light_for(const worlds::CameraSensor& sensor);

/// Takes the picture: lens, chip and encoding as the sensor says (develop.h), independent for each pixel,
/// channel, camera and frame, rounded to whole levels (which adds a variance of 1/12 of its own), clamped to
/// 0..255.
///
/// Noise is a function of (seed, frame, camera, position) alone, the numbers of
/// slam::RandomStream(seed, stream, 2 * frame + camera): frame 17 alone gets what frame 17 of a run gets.
/// @param frame both cameras' colour
/// @param frame_index >= 0, counts the instants of a run
/// @return pictures of the same size; a sensor that changes nothing leaves them the frame's pixels
/// @throws std::invalid_argument when a number of the sensor is out of range, or a picture has neither 8 nor
/// 16 bits
vision::StereoPair expose(const StereoFrame& frame, const worlds::CameraSensor& sensor, std::uint64_t seed,
                          std::uint64_t frame_index);

}  // namespace stereobench::renderer
