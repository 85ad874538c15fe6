/// Pictures of files, whoever made them: the one place where they are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// What a file says, byte for byte.
using PictureBytes = std::span<const std::uint8_t>;

/// The picture of a PNG, JPEG, TIFF, BMP, PNM or TGA file, told apart by how it begins. 16 bits become 8
/// (rounded), palettes become colours, transparency is left out; a JPEG's note of how the camera was held
/// turns nothing.
/// @param longest_px what its longer side may have: a larger one is refused by what the file says of its
///   size, before anything is made of it
/// @return CV_8UC1 for shades of grey, CV_8UC3 (BGR) for colours
/// @throws std::runtime_error that says of the file, in one line, "is cut short: ...", "is 8000 x 9 ..."
cv::Mat decode_picture(PictureBytes bytes, int longest_px = std::numeric_limits<int>::max());

/// What a file says of how its levels stand for light.
enum class SaidOfLevels { kNothing, kLinear, kSrgb };

/// JPEGs are sRGB (JFIF has no other); PNGs may say so, or their gamma. Others say nothing.
/// @return kNothing as well for what cannot be read
SaidOfLevels said_of_levels(PictureBytes bytes);

/// All of a file, whatever it holds.
/// @throws std::runtime_error where it cannot be read
std::vector<std::uint8_t> picture_bytes(const std::filesystem::path& file);

}  // namespace stereobench::renderer
