/// Pictures from anywhere, as the vision stage takes them.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <opencv2/core.hpp>

#include "worlds/camera_sensor.h"

namespace stereobench::harness {

/// Reads a picture of any format that there is a reader for (renderer/pictures/picture_reader.h).
/// @return CV_8UC1 or CV_8UC3 (BGR), as the file has colours or not
/// @throws std::runtime_error, one line, for a file that is missing, no picture, or cut short
cv::Mat read_levels(const std::filesystem::path& file);

/// Reads a PNG with all its bits, for what is measured in levels.
/// @return CV_8UC1, CV_8UC3, CV_16UC1 or CV_16UC3 (blue first)
/// @throws std::runtime_error as read_levels does
cv::Mat read_exact_png(const std::filesystem::path& file);

/// Reads a picture as read_levels does, which has to have colours.
/// @return CV_8UC3, BGR
/// @throws std::runtime_error, one line, as read_levels does, and without colour
cv::Mat read_picture(const std::filesystem::path& file);

/// The same as grey levels, for what is found by shape; pictures without colour are welcome.
/// @return CV_8UC1
/// @throws std::runtime_error as read_levels does
cv::Mat read_grey_picture(const std::filesystem::path& file);

/// How the levels of pictures stand for light: what `asked` says, or where that is "auto" what their files
/// say; pictures of which no file says anything, as ours, are of linear light.
/// @param asked auto, linear or srgb
/// @throws std::runtime_error, one line, where files contradict each other or cannot be read
worlds::Encoding encoding_of(const std::string& asked, std::span<const std::filesystem::path> files);

/// Whether a file's name says that it is a picture.
bool is_picture_name(const std::filesystem::path& file);

}  // namespace stereobench::harness
