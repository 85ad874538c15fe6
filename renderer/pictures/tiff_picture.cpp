#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include <opencv2/imgproc.hpp>
#include <tiffio.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

constexpr tmsize_t kMostMemory = tmsize_t{1} << 30U;  // of one piece: a damaged file may claim anything

/// A file in memory, as libtiff asks for it.
struct Input {
  PictureBytes bytes;
  std::size_t at = 0;
  std::string complaint = "its parts cannot be made out";
};

tmsize_t take(thandle_t handle, void* to, tmsize_t size) {
  auto& input = *static_cast<Input*>(handle);
  const std::size_t left = input.bytes.size() - std::min(input.at, input.bytes.size());
  const std::size_t taken = std::min(static_cast<std::size_t>(size), left);
  if (taken > 0) std::copy_n(input.bytes.data() + input.at, taken, static_cast<std::uint8_t*>(to));
  input.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t put_nothing(thandle_t, void*, tmsize_t) {
  return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
  auto& input = *static_cast<Input*>(handle);
  const std::size_t begin = from == SEEK_SET ? 0 : from == SEEK_CUR ? input.at : input.bytes.size();
  return input.at = begin + offset;
}

int close_nothing(thandle_t) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return static_cast<Input*>(handle)->bytes.size();
}

int complain(TIFF*, void* input, const char*, const char* format, va_list values) {
  char text[200];
  std::vsnprintf(text, sizeof text, format, values);
  static_cast<Input*>(input)->complaint = text;
  return 1;
}

int pass_over(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

using OpenTiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

OpenTiff open(Input& input) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), complain, &input);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), pass_over, nullptr);
  return {TIFFClientOpenExt("", "rm", &input, take, put_nothing, seek, close_nothing, size_of, nullptr,
                            nullptr, options.get()),
          TIFFClose};
}

/// A tag's number, 0 where there is none.
template <typename Number>
Number tag(TIFF* tiff, std::uint32_t name) {
  Number value = 0;
  TIFFGetFieldDefaulted(tiff, name, &value);
  return value;
}

bool is_grey(TIFF* tiff) {
  const auto kind = tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC);
  return kind == PHOTOMETRIC_MINISBLACK || kind == PHOTOMETRIC_MINISWHITE;
}

/// Rows of 16-bit shades, of which libtiff's own reader would drop the lower byte.
bool is_deep_grey(TIFF* tiff) {
  return tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISBLACK &&
         tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE) == 16 &&
         tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL) == 1 &&
         tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_UINT && TIFFIsTiled(tiff) == 0;
}

/// @return nothing where the file is damaged
cv::Mat deep_grey(TIFF* tiff, int width, int height) {
  cv::Mat deep(height, width, CV_16UC1), levels;
  if (TIFFScanlineSize(tiff) > static_cast<tmsize_t>(deep.step[0])) return {};
  for (int v = 0; v < height; ++v)
    if (TIFFReadScanline(tiff, deep.ptr(v), static_cast<std::uint32_t>(v), 0) != 1) return {};
  deep.convertTo(levels, CV_8U, 1.0 / 257.0);
  return levels;
}

/// @return nothing where the file is damaged
cv::Mat shades_or_colours(TIFF* tiff, int width, int height) {
  cv::Mat rgba(height, width, CV_8UC4), levels;
  if (TIFFReadRGBAImageOriented(tiff, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                rgba.ptr<std::uint32_t>(), ORIENTATION_TOPLEFT, 1) == 0)
    return {};
  if (is_grey(tiff))
    cv::extractChannel(rgba, levels, 0);
  else
    cv::cvtColor(rgba, levels, cv::COLOR_RGBA2BGR);
  return levels;
}

}  // namespace

cv::Mat decode_tiff(PictureBytes bytes, int longest_px) {
  Input input{bytes};
  const OpenTiff tiff = open(input);
  if (tiff == nullptr) refuse_broken(input.complaint);
  const auto width = tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGEWIDTH);
  const auto height = tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGELENGTH);
  check_size(width, height, longest_px);
  char why_not[1024] = "";
  if (TIFFRGBAImageOK(tiff.get(), why_not) == 0) refuse_broken(why_not);
  const auto read = is_deep_grey(tiff.get()) ? deep_grey : shades_or_colours;
  cv::Mat picture = read(tiff.get(), static_cast<int>(width), static_cast<int>(height));
  if (picture.empty()) refuse_broken(input.complaint);
  return picture;
}

}  // namespace stereobench::renderer
