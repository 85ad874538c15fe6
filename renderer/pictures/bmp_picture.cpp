#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

constexpr std::size_t kFileHeader = 14, kOldestHeader = 40;  // bytes

std::uint32_t number(PictureBytes bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) refuse_broken("it is cut short");
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8U | bytes[at + i];
  return value;
}

struct BmpLayout {
  int width = 0;
  int height = 0;
  bool upside_down = true;
  std::size_t pixel_bytes = 0;
  std::size_t row_bytes = 0;
  std::size_t first = 0;  ///< byte of the pixels
};

/// Whether pixels are plain: not packed, or with masks that say blue, green, red.
bool is_plain(PictureBytes bytes) {
  const std::uint32_t bits = number(bytes, 28, 2), packing = number(bytes, 30, 4);
  if (packing == 0) return bits == 8 || bits == 24 || bits == 32;
  return packing == 3 && bits == 32 && number(bytes, 54, 4) == 0xFF0000 && number(bytes, 58, 4) == 0xFF00 &&
         number(bytes, 62, 4) == 0xFF;
}

BmpLayout layout_of(PictureBytes bytes, int longest_px) {
  if (number(bytes, kFileHeader, 4) < kOldestHeader || !is_plain(bytes))
    throw std::runtime_error("is a packed BMP, which cannot be read");
  const std::int64_t width = static_cast<std::int32_t>(number(bytes, 18, 4));
  const std::int64_t height = static_cast<std::int32_t>(number(bytes, 22, 4));
  check_size(width, std::abs(height), longest_px);
  BmpLayout layout{static_cast<int>(width), static_cast<int>(std::abs(height)), height > 0};
  layout.pixel_bytes = number(bytes, 28, 2) / 8;
  layout.row_bytes = (layout.pixel_bytes * static_cast<std::size_t>(width) + 3) / 4 * 4;
  layout.first = number(bytes, 10, 4);
  if (layout.first + layout.row_bytes * static_cast<std::size_t>(layout.height) > bytes.size())
    refuse_broken("it is cut short");
  return layout;
}

using Palette = std::array<cv::Vec3b, 256>;

Palette palette_of(PictureBytes bytes) {
  const std::uint32_t used = number(bytes, 46, 4);
  if (used > 256) refuse_broken("its palette has no end");
  Palette palette{};
  for (std::size_t i = 0; i < (used == 0 ? 256 : used); ++i) {
    const std::size_t at = kFileHeader + number(bytes, kFileHeader, 4) + 4 * i;
    for (std::size_t c = 0; c < 3; ++c)
      palette[i][static_cast<int>(c)] = static_cast<std::uint8_t>(number(bytes, at + c, 1));
  }
  return palette;
}

bool is_grey(const Palette& palette) {
  return std::all_of(palette.begin(), palette.end(),
                     [](const cv::Vec3b& bgr) { return bgr[0] == bgr[1] && bgr[1] == bgr[2]; });
}

}  // namespace

cv::Mat decode_bmp(PictureBytes bytes, int longest_px) {
  const BmpLayout layout = layout_of(bytes, longest_px);
  const bool indexed = layout.pixel_bytes == 1;
  const Palette palette = indexed ? palette_of(bytes) : Palette{};
  cv::Mat picture(layout.height, layout.width, CV_8UC3);
  for (int v = 0; v < layout.height; ++v) {
    const int row = layout.upside_down ? layout.height - 1 - v : v;
    const std::uint8_t* from = &bytes[layout.first + layout.row_bytes * static_cast<std::size_t>(row)];
    for (int u = 0; u < layout.width; ++u, from += layout.pixel_bytes)
      picture.at<cv::Vec3b>(v, u) = indexed ? palette[*from] : cv::Vec3b(from[0], from[1], from[2]);
  }
  if (!indexed || !is_grey(palette)) return picture;
  cv::Mat grey;
  cv::extractChannel(picture, grey, 0);
  return grey;
}

}  // namespace stereobench::renderer
