/// What the pictures of a data set hold of what the camera measured.
#pragma once

#include <string_view>

#include <opencv2/core.hpp>

namespace stereobench::harness {

enum class PictureKind {
  kColour,   ///< as the camera stored it: 8 bits, three channels
  kGrey,     ///< 8 bits, the luma of the stored levels
  kBayer,    ///< 8 bits, a mosaic of the stored levels: rows R G R G ... and G B G B ...
  kLinear16  ///< 16 bits, three channels: the levels before they were encoded and rounded
};

/// What the command line and dataset.json call it: "colour", "grey", "bayer-rggb", "linear16".
std::string_view name_of(PictureKind kind);

/// @throws std::runtime_error, one line that begins with "--picture: " and lists the kinds, for another word
PictureKind parse_picture_kind(std::string_view text);

/// The type of OpenCV that a picture of a kind has.
int type_of(PictureKind kind);

/// A picture in another kind. Grey is ITU-R BT.601 of the levels as they are. The mosaic takes the one
/// channel that the pixel's filter lets through: noise was drawn for each channel, as three chips would have
/// it.
/// @param picture as the camera gives it: of kLinear16 CV_16UC3, else CV_8UC3, BGR
/// @return of type_of(kind)
cv::Mat in_kind(const cv::Mat& picture, PictureKind kind);

}  // namespace stereobench::harness
