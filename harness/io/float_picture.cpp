#include "harness/io/float_picture.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/io/text_file.h"
#include "renderer/pictures/float_tiff.h"

namespace stereobench::harness {
namespace {

constexpr int kLongest_px = 1 << 15;

[[noreturn]] void refuse_map(const std::filesystem::path& file, const char* why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

void reverse_bytes(cv::Mat& rows) {
  for (auto* word = rows.datastart; word != rows.dataend; word += sizeof(float))
    std::reverse(const_cast<uchar*>(word), const_cast<uchar*>(word) + sizeof(float));
}

cv::Mat tiff(const std::filesystem::path& file, const std::string& bytes) {
  try {
    return renderer::decode_float_tiff({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                                       kLongest_px);
  } catch (const std::runtime_error& error) {
    refuse_map(file, error.what());
  }
}

}  // namespace

cv::Mat read_float_picture(const std::filesystem::path& file) {
  const std::string bytes = read_text(file);
  if (bytes.starts_with("II*") || bytes.starts_with("MM")) return tiff(file, bytes);
  static_assert(std::endian::native == std::endian::little);
  std::istringstream header(bytes.substr(0, std::min<std::size_t>(bytes.size(), 200)));
  std::string kind;
  int width = 0, height = 0;
  double scale = 0.0;
  header >> kind >> width >> height >> scale;
  if (!header || (kind != "Pf" && kind != "PF") || scale == 0.0)
    refuse_map(file, "is neither a portable float map (PFM) nor a TIFF file");
  if (width < 1 || height < 1 || width > kLongest_px || height > kLongest_px)
    refuse_map(file, "has no size that a picture may have");
  const std::size_t begin = static_cast<std::size_t>(header.tellg()) + 1;
  const int type = kind == "Pf" ? CV_32FC1 : CV_32FC3;
  const std::size_t pixel = kind == "Pf" ? sizeof(float) : 3 * sizeof(float);
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel;
  if (bytes.size() != begin + size) refuse_map(file, "is cut short, or longer than it says");
  cv::Mat rows(height, width, type);
  std::memcpy(rows.data, bytes.data() + begin, size);
  if (scale > 0.0) reverse_bytes(rows);
  cv::Mat picture;
  cv::flip(rows, picture, 0);  // the lowest row comes first
  if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_RGB2BGR);
  return picture;
}

}  // namespace stereobench::harness
