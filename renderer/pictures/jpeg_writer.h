/// Pictures as JPEG files, for people to look at.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// The bytes of a picture's JPEG file, colours at half the resolution of brightness.
/// @param picture CV_8UC3 (BGR), not empty
/// @param quality from 1 to 100
/// @throws std::invalid_argument when it is no such picture or quality
std::vector<std::uint8_t> encode_jpeg(const cv::Mat& picture, int quality);

}  // namespace stereobench::renderer
