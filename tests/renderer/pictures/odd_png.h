/// PNG files of the kinds that OpenCV does not write.
#pragma once

#include <cstdint>
#include <vector>

#include <png.h>

namespace stereobench::renderer::test {

struct OddPng {
  int colour = PNG_COLOR_TYPE_GRAY;
  int bits = 8;
  bool interlaced = false;
  bool one_is_clear = false;  ///< one shade or colour is transparent
};

inline std::vector<OddPng> every_png() {
  std::vector<OddPng> kinds;
  for (const bool interlaced : {false, true}) {
    for (const int bits : {1, 2, 4, 8, 16}) kinds.push_back({PNG_COLOR_TYPE_GRAY, bits, interlaced});
    for (const int bits : {1, 2, 4, 8}) {
      kinds.push_back({PNG_COLOR_TYPE_PALETTE, bits, interlaced});
      kinds.push_back({PNG_COLOR_TYPE_PALETTE, bits, interlaced, true});
      kinds.push_back({PNG_COLOR_TYPE_GRAY, bits, interlaced, true});
    }
    for (const int bits : {8, 16}) {
      kinds.push_back({PNG_COLOR_TYPE_RGB, bits, interlaced, true});
      kinds.push_back({PNG_COLOR_TYPE_GRAY_ALPHA, bits, interlaced});
      kinds.push_back({PNG_COLOR_TYPE_RGBA, bits, interlaced});
    }
  }
  return kinds;
}

inline void append_to(png_structp png, png_bytep from, std::size_t size) {
  auto& file = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  file.insert(file.end(), from, from + size);
}

/// Bytes that look like noise as its pixels.
inline std::vector<std::uint8_t> odd_png(const OddPng& kind, unsigned width, unsigned height) {
  std::vector<std::uint8_t> file, row(width * 8);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &file, append_to, nullptr);
  png_set_IHDR(png, info, width, height, kind.bits, kind.colour,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette(std::size_t{1} << static_cast<unsigned>(kind.bits == 16 ? 1 : kind.bits));
  for (std::size_t i = 0; i < palette.size(); ++i)
    palette[i] = {static_cast<png_byte>(37 * i), static_cast<png_byte>(91 * i),
                  static_cast<png_byte>(255 - i)};
  if (kind.colour == PNG_COLOR_TYPE_PALETTE)
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  const png_byte clear[] = {255, 0};
  const png_color_16 clear_colour{0, 1, 1, 1, 1};
  if (kind.one_is_clear) png_set_tRNS(png, info, clear, 2, &clear_colour);
  png_write_info(png, info);
  const int passes = png_set_interlace_handling(png);
  for (int pass = 0; pass < passes; ++pass) {
    std::uint32_t noise = 1;
    for (unsigned v = 0; v < height; ++v) {
      for (std::uint8_t& byte : row)
        byte = static_cast<std::uint8_t>((noise = noise * 1664525 + 1013904223) >> 24U);
      png_write_row(png, row.data());
    }
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

}  // namespace stereobench::renderer::test
