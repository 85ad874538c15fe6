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
  cv::Mat rows;
  cv::flip(picture, rows, 0);
  if (colour) cv::cvtColor(rows, rows, cv::COLOR_BGR2RGB);
  std::string bytes = fmt::format("{}\n{} {}\n-1\n", colour ? "PF" : "Pf", rows.cols, rows.rows);
  return bytes.append(rows.datastart, rows.dataend);
}

}  // namespace

std::string encoded(std::string_view extension, const cv::Mat& picture) {
  if (extension == ".png") {
    const std::vector<std::uint8_t> bytes = renderer::encode_png(picture);
    return {bytes.begin(), bytes.end()};
  }
  if (extension == ".pfm" && (picture.type() == CV_32FC1 || picture.type() == CV_32FC3)) return pfm(picture);
  throw std::invalid_argument(fmt::format("a picture that a file {} does not hold", extension));
}

}  // namespace stereobench::harness
