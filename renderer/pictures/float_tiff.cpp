#include "renderer/pictures/float_tiff.h"

#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "renderer/pictures/tiff_memory.h"

namespace stereobench::renderer {
namespace {

constexpr int kRowsPerStrip = 64;
constexpr int kZstdLevel = 1;

void set_float_tags(TIFF* tiff, const cv::Mat& picture) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(picture.cols));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(picture.rows));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, picture.channels());
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, picture.channels() == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kRowsPerStrip);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ZSTD);
  TIFFSetField(tiff, TIFFTAG_ZSTD_LEVEL, kZstdLevel);
}

/// Whether rows have a number for each pixel and channel; where rows share colours, libtiff makes other ones.
bool holds_floats(TIFF* tiff) {
  const auto samples = tiff_tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL);
  const auto width = tiff_tag<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH);
  return tiff_tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE) == 32 &&
         tiff_tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP &&
         tiff_tag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG &&
         (samples == 1 || samples == 3) && TIFFIsTiled(tiff) == 0 &&
         static_cast<std::size_t>(TIFFScanlineSize(tiff)) == std::size_t{width} * samples * sizeof(float);
}

}  // namespace

std::string encode_float_tiff(const cv::Mat& picture) {
  cv::Mat ordered;  // red first
  if (picture.channels() == 3)
    cv::cvtColor(picture, ordered, cv::COLOR_BGR2RGB);
  else
    ordered = picture.isContinuous() ? picture : picture.clone();
  TiffOutput output;
  OpenTiff tiff = open_tiff(output);
  set_float_tags(tiff.get(), ordered);
  std::uint32_t strip = 0;
  for (int row = 0; row < ordered.rows; row += kRowsPerStrip) {
    const cv::Mat rows = ordered.rowRange(row, std::min(row + kRowsPerStrip, ordered.rows));
    const auto size = static_cast<tmsize_t>(rows.total() * rows.elemSize());
    if (TIFFWriteEncodedStrip(tiff.get(), strip++, rows.data, size) != size)
      throw std::runtime_error("libtiff cannot compress with Zstandard");
  }
  tiff.reset();
  return std::move(output.bytes);
}

cv::Mat decode_float_tiff(PictureBytes bytes, int longest_px) {
  TiffInput input{bytes};
  const OpenTiff tiff = open_tiff(input);
  if (tiff == nullptr) refuse_broken(input.complaint);
  if (!holds_floats(tiff.get()))
    throw std::runtime_error("expected floats of 32 bits, 1 or 3 channels, in strips");
  const auto width = tiff_tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGEWIDTH);
  const auto height = tiff_tag<std::uint32_t>(tiff.get(), TIFFTAG_IMAGELENGTH);
  check_size(width, height, longest_px);
  const bool has_colours = tiff_tag<std::uint16_t>(tiff.get(), TIFFTAG_SAMPLESPERPIXEL) == 3;
  cv::Mat picture(static_cast<int>(height), static_cast<int>(width), has_colours ? CV_32FC3 : CV_32FC1);
  for (int v = 0; v < picture.rows; ++v)
    if (TIFFReadScanline(tiff.get(), picture.ptr(v), static_cast<std::uint32_t>(v), 0) != 1)
      refuse_broken(input.complaint);
  if (has_colours) cv::cvtColor(picture, picture, cv::COLOR_RGB2BGR);
  return picture;
}

}  // namespace stereobench::renderer
