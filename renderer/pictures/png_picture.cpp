#include "renderer/pictures/png_picture.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <stdexcept>
#include <string>

#include <png.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

/// What libpng works on. It leaves by jumps, which pass over destructors: all that has one is kept here,
/// outside of the functions that it jumps out of.
struct Work {
  PictureBytes input;
  int longest_px = 0;
  bool keeps_16_bits = false;
  cv::Mat picture;
  std::vector<png_bytep> rows;
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
  if (work.keeps_16_bits)
    png_set_swap(png);  // PNG has the higher byte first
  else
    png_set_scale_16(png);
  png_set_strip_alpha(png);
  png_set_bgr(png);
  png_read_update_info(png, info);
  const int depth = png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U;
  work.picture.create(static_cast<int>(png_get_image_height(png, info)),
                      static_cast<int>(png_get_image_width(png, info)),
                      CV_MAKETYPE(depth, png_get_channels(png, info)));
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

cv::Mat decode_exact_png(PictureBytes bytes, int longest_px) {
  Work work{.input = bytes, .longest_px = longest_px, .keeps_16_bits = true};
  const Reader reader(work);
  if (!runs(read, reader.png, reader.info, work)) refuse_broken(work.complaint);
  return work.picture;
}

SaidOfLevels said_by_png(PictureBytes bytes) {
  Work work{.input = bytes};
  const Reader reader(work);
  return runs(read_note, reader.png, reader.info, work) ? work.said : SaidOfLevels::kNothing;
}

}  // namespace stereobench::renderer
