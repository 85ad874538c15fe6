#include "harness/dataset/pictures/picture_kind.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/dataset/formats/rectified_pair.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

/// By PictureKind.
constexpr std::array<std::string_view, 4> kKindNames = {"colour", "grey", "bayer-rggb", "linear16"};
constexpr std::array kKindTypes = {CV_8UC3, CV_8UC1, CV_8UC1, CV_16UC3};

/// @param bgr CV_8UC3
cv::Mat mosaic_of(const cv::Mat& bgr) {
  cv::Mat mosaic(bgr.size(), CV_8UC1);
  for (int row = 0; row < bgr.rows; ++row)
    for (int column = 0; column < bgr.cols; ++column) {
      const int channel = 2 - row % 2 - column % 2;  // red where both are even, blue where both are odd
      mosaic.at<std::uint8_t>(row, column) = bgr.at<cv::Vec3b>(row, column)[channel];
    }
  return mosaic;
}

}  // namespace

std::string_view name_of(PictureKind kind) {
  return kKindNames.at(static_cast<std::size_t>(kind));
}

PictureKind parse_picture_kind(std::string_view text) {
  const auto* const found = std::ranges::find(kKindNames, text);
  if (found == kKindNames.end())
    throw std::runtime_error(
        fmt::format("--picture: expected {} (got '{}')", fmt::join(kKindNames, ", "), worlds::excerpt(text)));
  return static_cast<PictureKind>(found - kKindNames.begin());
}

int type_of(PictureKind kind) {
  return kKindTypes.at(static_cast<std::size_t>(kind));
}

cv::Mat in_kind(const cv::Mat& picture, PictureKind kind) {
  if (kind == PictureKind::kGrey) return grey_of(picture);
  if (kind == PictureKind::kBayer) return mosaic_of(picture);
  return picture;
}

}  // namespace stereobench::harness
