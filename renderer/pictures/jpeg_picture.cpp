#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include <turbojpeg.h>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

bool has_an_end(PictureBytes bytes) {
  constexpr std::array<std::uint8_t, 2> kEnd = {0xFF, 0xD9};
  return std::search(bytes.begin(), bytes.end(), kEnd.begin(), kEnd.end()) != bytes.end();
}

}  // namespace

cv::Mat decode_jpeg(PictureBytes bytes, int longest_px) {
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitDecompress(), tjDestroy);
  const auto size = static_cast<unsigned long>(bytes.size());
  int width = 0, height = 0, sampling = 0, colours = 0;
  if (tjDecompressHeader3(jpeg.get(), bytes.data(), size, &width, &height, &sampling, &colours) != 0)
    refuse_broken(tjGetErrorStr2(jpeg.get()));
  check_size(width, height, longest_px);
  if (colours == TJCS_CMYK || colours == TJCS_YCCK)
    throw std::runtime_error("is a picture in four printing colours, which cannot be read");
  const bool grey = colours == TJCS_GRAY;
  cv::Mat picture(height, width, grey ? CV_8UC1 : CV_8UC3);
  if (tjDecompress2(jpeg.get(), bytes.data(), size, picture.data, width, static_cast<int>(picture.step[0]),
                    height, grey ? TJPF_GRAY : TJPF_BGR, TJFLAG_LIMITSCANS) == 0)
    return picture;
  // What is cut short is filled up with grey. Cameras leave stray bytes behind, which harm nobody; but of
  // several warnings the first alone is told.
  const std::string complaint = tjGetErrorStr2(jpeg.get());
  if (complaint.find("extraneous bytes") == std::string::npos || !has_an_end(bytes)) refuse_broken(complaint);
  return picture;
}

}  // namespace stereobench::renderer
