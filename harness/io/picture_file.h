/// Pictures as the bytes of files.
#pragma once

#include <string>
#include <string_view>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// The bytes of a picture's file.
/// @param extension says the format: ".png" (8 or 16 bits; 1, 3 or 4 channels) ".pfm" or ".tiff" (CV_32F;
/// 1 or 3 channels)
/// @throws std::invalid_argument when the format does not hold such a picture
std::string encoded(std::string_view extension, const cv::Mat& picture);

}  // namespace stereobench::harness
