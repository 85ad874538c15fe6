#include "harness/io/picture_file.h"

#include <bit>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "renderer/pictures/float_tiff.h"
#include "renderer/pictures/png_picture.h"

namespace stereobench::harness {
namespace {

/// Portable float map: the lowest row first, a negative scale for numbers with their lowest byte first.
std::string pfm(const cv::Mat& picture) {
  static_assert(std::endian::native == std::endian::little);
  const bool colour = picture.channels() == 3;
  std::string bytes = fmt::format("{}\n{} {}\n-1\n", colour ? "PF" : "Pf", picture.cols, picture.rows);
  bytes.reserve(bytes.size() + picture.total() * picture.elemSize());
  cv::Mat ordered;  // one row, red first
  for (int v = picture.rows; v-- > 0;) {
    const cv::Mat row = picture.row(v);
    if (colour) cv::cvtColor(row, ordered, cv::COLOR_BGR2RGB);
    const cv::Mat& from = colour ? ordered : row;
    bytes.append(from.ptr<char>(), from.total() * from.elemSize());
  }
  return bytes;
}

}  // namespace

std::string encoded(std::string_view extension, const cv::Mat& picture) {
  if (extension == ".png") {
    const std::vector<std::uint8_t> bytes = renderer::encode_png(picture);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  const bool holds_floats = picture.type() == CV_32FC1 || picture.type() == CV_32FC3;
  if (extension == ".pfm" && holds_floats) return pfm(picture);
  if (extension == ".tiff" && holds_floats) return renderer::encode_float_tiff(picture);
  throw std::invalid_argument(fmt::format("a picture that a file {} does not hold", extension));
}

}  // namespace stereobench::harness
