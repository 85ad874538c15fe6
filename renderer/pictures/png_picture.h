/// Pictures as PNG files.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// How hard a PNG is packed.
enum class PngPacking {
  kRuns,   ///< differences between neighbours, their runs and frequent ones short: for what is kept
  kStored  ///< not at all: for what is read once. Twice the size, in a fifth of the time
};

/// The bytes of a picture's PNG file.
/// @param picture 8 or 16 bits a channel; 1, 3 (BGR) or 4 (BGRA) channels
/// @throws std::invalid_argument when it is no such picture, or empty
std::vector<std::uint8_t> encode_png(const cv::Mat& picture, PngPacking packing = PngPacking::kRuns);

/// The picture of a PNG file with all its bits.
/// @return as decode_picture (picture_reader.h), but CV_16UC1 or CV_16UC3 where the file has 16 bits a
/// channel
/// @throws std::runtime_error as decode_picture
cv::Mat decode_exact_png(std::span<const std::uint8_t> bytes,
                         int longest_px = std::numeric_limits<int>::max());

}  // namespace stereobench::renderer
