/// Pictures from anywhere, as the vision stage takes them.
#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// Reads a picture: PNG, JPEG, BMP, TIFF, PNM. 16 bits become 8, transparency is left out.
/// @return CV_8UC3, BGR
/// @throws std::runtime_error, one line, for a file that is missing, no picture, cut short, or without colour
cv::Mat read_picture(const std::filesystem::path& file);

/// The same as grey levels, for what is found by shape; pictures without colour are welcome.
/// @return CV_8UC1
/// @throws std::runtime_error, one line, for a file that is missing, no picture, or cut short
cv::Mat read_grey_picture(const std::filesystem::path& file);

/// Whether a file's name says that it is a picture.
bool is_picture_name(const std::filesystem::path& file);

}  // namespace stereobench::harness
