/// Pictures of floats as TIFF files: every bit, compressed.
#pragma once

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {

/// The bytes of a TIFF file of 32-bit floats, compressed with Zstandard after libtiff's predictor for floats.
/// @param picture CV_32FC1, or CV_32FC3 with blue first, which becomes red first as files have it
std::string encode_float_tiff(const cv::Mat& picture);

/// Reads such a file, of any of libtiff's compressions, in strips, with or without predictor.
/// @return CV_32FC1, or CV_32FC3 with blue first
/// @throws std::runtime_error, without the file's name, for another TIFF and a damaged one
cv::Mat decode_float_tiff(PictureBytes bytes, int longest_px);

}  // namespace stereobench::renderer
