/// Pictures as files that are written whole, once.
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// The bytes of a picture's file. @param extension says the format: ".png", ".pfm"
std::string encoded(const char* extension, const cv::Mat& picture);

/// Writes a picture unless the file is there already.
/// @throws std::runtime_error as write_file_atomically
void write_once(const std::filesystem::path& path, const cv::Mat& picture);

}  // namespace stereobench::harness
