#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

constexpr std::size_t kHeaderBytes = 18;
constexpr std::size_t kLongestPacket = 128;  // pixels of a packet

enum class TgaKind { kPalette = 1, kColour = 2, kGrey = 3 };

/// The header, of Truevision's specification 2.0.
struct TgaHeader {
  TgaKind kind = TgaKind::kColour;
  bool packed = false;
  bool has_palette = false;
  int first_entry = 0, entries = 0;
  int entry_bits = 0, pixel_bits = 0;
  int width_px = 0, height_px = 0;
  bool from_right = false, from_top = false;
  std::size_t id_bytes = 0;

  std::size_t entry_bytes() const { return static_cast<std::size_t>(entry_bits + 7) / 8; }
  std::size_t pixel_bytes() const { return static_cast<std::size_t>(pixel_bits + 7) / 8; }
  std::size_t palette_at() const { return kHeaderBytes + id_bytes; }
  /// True colour may have a palette as well, which nobody uses.
  std::size_t pixels_at() const {
    return palette_at() + (has_palette ? static_cast<std::size_t>(entries) * entry_bytes() : 0);
  }
};

int number(PictureBytes bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8U;
}

bool is_colour_depth(int bits) {
  return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

TgaHeader header_of(PictureBytes bytes) {
  TgaHeader header;
  header.kind = static_cast<TgaKind>(bytes[2] & 7U);
  header.packed = (bytes[2] & 8U) != 0;
  header.has_palette = bytes[1] == 1;
  header.first_entry = number(bytes, 3);
  header.entries = number(bytes, 5);
  header.entry_bits = bytes[7];
  header.pixel_bits = bytes[16];
  header.width_px = number(bytes, 12);
  header.height_px = number(bytes, 14);
  header.from_right = (bytes[17] & 16U) != 0;
  header.from_top = (bytes[17] & 32U) != 0;
  header.id_bytes = bytes[0];
  return header;
}

/// Whether the numbers of a header suit each other: the format has no signature at its beginning.
bool suits(const TgaHeader& header) {
  switch (header.kind) {
    case TgaKind::kPalette:
      return header.has_palette && header.entries > 0 && is_colour_depth(header.entry_bits) &&
             (header.pixel_bits == 8 || header.pixel_bits == 16);
    case TgaKind::kColour:
      return is_colour_depth(header.pixel_bits);
    case TgaKind::kGrey:
      return header.pixel_bits == 8 || header.pixel_bits == 16;  // 16: with 8 of transparency
  }
  return false;
}

cv::Vec3b colour_of(const std::uint8_t* bytes, std::size_t size) {
  if (size > 2) return {bytes[0], bytes[1], bytes[2]};
  const unsigned packed = bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
  const auto level = [&](unsigned shift) {  // of five bits
    return static_cast<std::uint8_t>(((packed >> shift & 31U) * 255 + 15) / 31);
  };
  return {level(0), level(5), level(10)};
}

/// All pixels as the file has them, packets taken apart.
std::vector<std::uint8_t> unpacked(PictureBytes bytes, const TgaHeader& header) {
  const std::size_t size = header.pixel_bytes();
  const std::size_t pixels =
      static_cast<std::size_t>(header.width_px) * static_cast<std::size_t>(header.height_px);
  std::size_t at = header.pixels_at();
  const auto take = [&](std::size_t count) {
    if (at > bytes.size() || count > bytes.size() - at) refuse_broken("it is cut short");
    return bytes.subspan(std::exchange(at, at + count), count);
  };
  if (!header.packed) {
    const PictureBytes all = take(pixels * size);
    return {all.begin(), all.end()};
  }
  if (bytes.size() < pixels / kLongestPacket)
    refuse_broken("it is cut short");  // before there is room for it
  std::vector<std::uint8_t> raw;
  raw.reserve(pixels * size);
  for (std::size_t left = pixels; left > 0;) {
    const std::uint8_t head = take(1).front();
    const std::size_t length = std::min<std::size_t>((head & 127U) + 1, left);
    const bool repeats = (head & 128U) != 0;
    const PictureBytes packet = take((repeats ? 1 : length) * size);
    for (std::size_t i = 0; i < (repeats ? length : 1); ++i)
      raw.insert(raw.end(), packet.begin(), packet.end());
    left -= length;
  }
  return raw;
}

std::vector<cv::Vec3b> palette_of(PictureBytes bytes, const TgaHeader& header) {
  if (header.pixels_at() > bytes.size()) refuse_broken("it is cut short");
  std::vector<cv::Vec3b> palette;
  for (std::size_t i = 0; i < static_cast<std::size_t>(header.entries); ++i)
    palette.push_back(
        colour_of(&bytes[header.palette_at() + i * header.entry_bytes()], header.entry_bytes()));
  return palette;
}

cv::Vec3b entry(const std::vector<cv::Vec3b>& palette, const TgaHeader& header, const std::uint8_t* pixel) {
  const int index = (header.pixel_bits == 16 ? pixel[0] | pixel[1] << 8U : pixel[0]) - header.first_entry;
  if (index < 0 || index >= header.entries) refuse_broken("a pixel is of no colour of its palette");
  return palette[static_cast<std::size_t>(index)];
}

}  // namespace

bool is_tga(PictureBytes bytes) {
  if (bytes.size() < kHeaderBytes || bytes[1] > 1 || (bytes[2] & ~11U) != 0 || bytes[17] > 63) return false;
  const TgaHeader header = header_of(bytes);
  return header.width_px > 0 && header.height_px > 0 && suits(header);
}

cv::Mat decode_tga(PictureBytes bytes, int longest_px) {
  const TgaHeader header = header_of(bytes);
  check_size(header.width_px, header.height_px, longest_px);
  const std::vector<cv::Vec3b> palette =
      header.kind == TgaKind::kPalette ? palette_of(bytes, header) : std::vector<cv::Vec3b>();
  const std::vector<std::uint8_t> raw = unpacked(bytes, header);
  cv::Mat picture(header.height_px, header.width_px, header.kind == TgaKind::kGrey ? CV_8UC1 : CV_8UC3);
  const std::uint8_t* pixel = raw.data();
  for (int i = 0; i < header.height_px; ++i) {
    const int row = header.from_top ? i : header.height_px - 1 - i;
    for (int j = 0; j < header.width_px; ++j, pixel += header.pixel_bytes()) {
      const int column = header.from_right ? header.width_px - 1 - j : j;
      if (header.kind == TgaKind::kGrey)
        picture.at<std::uint8_t>(row, column) = *pixel;
      else
        picture.at<cv::Vec3b>(row, column) = header.kind == TgaKind::kPalette
                                                 ? entry(palette, header, pixel)
                                                 : colour_of(pixel, header.pixel_bytes());
    }
  }
  return picture;
}

}  // namespace stereobench::renderer
