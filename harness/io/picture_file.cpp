#include "harness/io/picture_file.h"

#include <bit>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

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
  if (extension == ".pfm" && (picture.type() == CV_32FC1 || picture.type() == CV_32FC3)) return pfm(picture);
  throw std::invalid_argument(fmt::format("a picture that a file {} does not hold", extension));
}

}  // namespace stereobench::harness
