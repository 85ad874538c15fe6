#include "renderer/pictures/picture_reader.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

using namespace std::string_view_literals;

struct Format {
  std::string_view begins_with;
  cv::Mat (*decode)(PictureBytes bytes, int longest_px);
};

constexpr Format kFormats[] = {{"\x89PNG"sv, decode_png}, {"\xFF\xD8\xFF"sv, decode_jpeg},
                               {"II*\0"sv, decode_tiff},  {"MM\0*"sv, decode_tiff},
                               {"II+\0"sv, decode_tiff},  {"MM\0+"sv, decode_tiff},
                               {"BM"sv, decode_bmp},      {"P2"sv, decode_pnm},
                               {"P3"sv, decode_pnm},      {"P5"sv, decode_pnm},
                               {"P6"sv, decode_pnm}};

constexpr std::int64_t kMostPixels = std::int64_t{1} << 28U;

}  // namespace

void refuse_broken(const std::string& library) {
  std::string line = library.substr(0, 200);
  std::replace_if(
      line.begin(), line.end(), [](char letter) { return letter < ' ' || letter > '~'; }, ' ');
  throw std::runtime_error("is no whole picture: " + line);
}

void check_size(std::int64_t width_px, std::int64_t height_px, int longest_px) {
  if (width_px < 1 || height_px < 1) refuse_broken("it has no pixels");
  if (width_px > kMostPixels / height_px)
    throw std::runtime_error(
        fmt::format("is {} x {} pixels, more than {} in all", width_px, height_px, kMostPixels));
  if (std::max(width_px, height_px) > longest_px)
    throw std::runtime_error(fmt::format("is {} x {}, more than {} pixels", width_px, height_px, longest_px));
}

cv::Mat decode_picture(PictureBytes bytes, int longest_px) {
  if (bytes.empty()) throw std::runtime_error("is empty");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Format& format : kFormats)
    if (text.starts_with(format.begins_with)) return format.decode(bytes, longest_px);
  if (is_tga(bytes)) return decode_tga(bytes, longest_px);
  throw std::runtime_error("is no picture that can be read (PNG, JPEG, TIFF, BMP, PNM, TGA)");
}

SaidOfLevels said_of_levels(PictureBytes bytes) {
  if (bytes.empty()) return SaidOfLevels::kNothing;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xFF\xD8\xFF"sv)) return SaidOfLevels::kSrgb;
  return text.starts_with("\x89PNG"sv) ? said_by_png(bytes) : SaidOfLevels::kNothing;
}

std::vector<std::uint8_t> picture_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad() || !stream.is_open()) throw std::runtime_error("cannot be read");
  return bytes;
}

}  // namespace stereobench::renderer
