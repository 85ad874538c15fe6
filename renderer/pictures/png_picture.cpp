#include "renderer/pictures/png_picture.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <stdexcept>
#include <string>

#include <png.h>
#include <zlib.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

/// What libpng works on. It leaves by jumps, which pass over destructors: all that has one is kept here,
/// outside of the functions that it jumps out of.
struct Work {
  PictureBytes input;
  int longest_px = 0;
  std::vector<std::uint8_t> output;
  cv::Mat picture;
  std::vector<png_bytep> rows;
  PngPacking packing = PngPacking::kRuns;
  std::string complaint;
  SaidOfLevels said = SaidOfLevels::kNothing;

  void point_at_rows() {
    for (int v = 0; v < picture.rows; ++v) rows.push_back(picture.ptr(v));
  }
};

void take(png_structp png, png_bytep to, std::size_t size) {
  PictureBytes& input = static_cast<Work*>(png_get_io_ptr(png))->input;
  if (size > input.size()) png_error(png, "it is cut short");
  std::copy_n(input.begin(), size, to);
  input = input.subspan(size);
}

void put(png_structp png, png_bytep from, std::size_t size) {
  std::vector<std::uint8_t>& output = static_cast<Work*>(png_get_io_ptr(png))->output;
  output.insert(output.end(), from, from + size);
}

[[noreturn]] void complain(png_structp png, png_const_charp why) {
  static_cast<Work*>(png_get_error_ptr(png))->complaint = why;
  png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

void read(png_structp png, png_infop info, Work& work) {
  png_set_read_fn(png, &work, take);
  png_read_info(png, info);
  check_size(png_get_image_width(png, info), png_get_image_height(png, info), work.longest_px);
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_strip_alpha(png);
  png_set_bgr(png);
  png_read_update_info(png, info);
  work.picture.create(static_cast<int>(png_get_image_height(png, info)),
                      static_cast<int>(png_get_image_width(png, info)), CV_8UC(png_get_channels(png, info)));
  work.point_at_rows();
  png_read_image(png, work.rows.data());
  png_read_end(png, nullptr);
}

/// An sRGB note, or a gamma: of sRGB's (1 / 2.2), or of light itself.
void read_note(png_structp png, png_infop info, Work& work) {
  constexpr double kNear = 0.05;
  png_set_read_fn(png, &work, take);
  png_read_info(png, info);
  double gamma = 0.0;
  if (png_get_valid(png, info, PNG_INFO_sRGB) != 0)
    work.said = SaidOfLevels::kSrgb;
  else if (png_get_gAMA(png, info, &gamma) != 0)
    work.said = std::abs(gamma - 1.0) < kNear         ? SaidOfLevels::kLinear
                : std::abs(gamma - 1.0 / 2.2) < kNear ? SaidOfLevels::kSrgb
                                                      : SaidOfLevels::kNothing;
}

void write(png_structp png, png_infop info, Work& work) {
  const cv::Mat& picture = work.picture;
  const int colour = picture.channels() == 1   ? PNG_COLOR_TYPE_GRAY
                     : picture.channels() == 3 ? PNG_COLOR_TYPE_RGB
                                               : PNG_COLOR_TYPE_RGBA;
  png_set_write_fn(png, &work, put, nullptr);
  const bool packed = work.packing == PngPacking::kRuns;
  png_set_filter(png, PNG_FILTER_TYPE_BASE, packed ? PNG_FILTER_SUB : PNG_FILTER_NONE);
  png_set_compression_level(png, packed ? Z_BEST_SPEED : Z_NO_COMPRESSION);
  png_set_compression_strategy(png, Z_RLE);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.cols), static_cast<png_uint_32>(picture.rows),
               picture.depth() == CV_8U ? 8 : 16, colour, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_bgr(png);
  png_set_swap(png);  // 16 bits: PNG has the higher byte first
  png_write_image(png, work.rows.data());
  png_write_end(png, info);
}

/// @return false where libpng has jumped back
bool runs(void (*function)(png_structp, png_infop, Work&), png_structp png, png_infop info, Work& work) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  function(png, info, work);
  return true;
}

struct Reader {
  explicit Reader(Work& work)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &work, complain, pass_over)),
        info(png_create_info_struct(png)) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  png_structp png;
  png_infop info;
};

}  // namespace

cv::Mat decode_png(PictureBytes bytes, int longest_px) {
  Work work{.input = bytes, .longest_px = longest_px};
  const Reader reader(work);
  if (!runs(read, reader.png, reader.info, work)) refuse_broken(work.complaint);
  return work.picture;
}

SaidOfLevels said_by_png(PictureBytes bytes) {
  Work work{.input = bytes};
  const Reader reader(work);
  return runs(read_note, reader.png, reader.info, work) ? work.said : SaidOfLevels::kNothing;
}

std::vector<std::uint8_t> encode_png(const cv::Mat& picture, PngPacking packing) {
  const int channels = picture.channels();
  const bool suitable = !picture.empty() && (picture.depth() == CV_8U || picture.depth() == CV_16U) &&
                        (channels == 1 || channels == 3 || channels == 4);
  if (!suitable)
    throw std::invalid_argument("encode_png: not a picture of 8 or 16 bits and 1, 3 or 4 channels");
  Work work{.picture = picture, .packing = packing};
  work.point_at_rows();
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &work, complain, pass_over);
  png_infop info = png_create_info_struct(png);
  const bool written = runs(write, png, info, work);
  png_destroy_write_struct(&png, &info);
  if (!written) throw std::runtime_error("cannot be written as PNG: " + work.complaint);
  return std::move(work.output);
}

}  // namespace stereobench::renderer
