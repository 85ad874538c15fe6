#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "renderer/pictures/picture_formats.h"
#include "renderer/pictures/tiff_memory.h"

namespace stereobench::renderer {
namespace {

bool is_grey(TIFF* tiff) {
  const auto kind = tiff_tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC);
  return kind == PHOTOMETRIC_MINISBLACK || kind == PHOTOMETRIC_MINISWHITE;
}

/// Rows of 16-bit shades, of which libtiff's own reader would drop the lower byte.
bool is_deep_grey(TIFF* tiff) {
  return tiff_tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISBLACK &&
         tiff_tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE) == 16 &&
         tiff_tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL) == 1 &&
         tiff_tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_UINT && TIFFIsTiled(tiff) == 0;
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
  TiffInput input{bytes};
  const OpenTiff tiff = open_tiff(input);
  if (tiff == nullptr) refuse_broken(input.complaint);
  const auto width = tiff_tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGEWIDTH);
  const auto height = tiff_tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGELENGTH);
  check_size(width, height, longest_px);
  char why_not[1024] = "";
  if (TIFFRGBAImageOK(tiff.get(), why_not) == 0) refuse_broken(why_not);
  const auto read = is_deep_grey(tiff.get()) ? deep_grey : shades_or_colours;
  cv::Mat picture = read(tiff.get(), static_cast<int>(width), static_cast<int>(height));
  if (picture.empty()) refuse_broken(input.complaint);
  return picture;
}

}  // namespace stereobench::renderer
