#include "renderer/pictures/jpeg_writer.h"

#include <memory>
#include <stdexcept>

#include <turbojpeg.h>

namespace stereobench::renderer {

std::vector<std::uint8_t> encode_jpeg(const cv::Mat& picture, int quality) {
  if (picture.type() != CV_8UC3 || picture.empty() || quality < 1 || quality > 100)
    throw std::invalid_argument("a JPEG is made of a CV_8UC3 picture, with a quality from 1 to 100");
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitCompress(), tjDestroy);
  std::vector<std::uint8_t> bytes(tjBufSize(picture.cols, picture.rows, TJSAMP_420));
  unsigned char* data = bytes.data();
  unsigned long size = bytes.size();
  if (tjCompress2(jpeg.get(), picture.data, picture.cols, static_cast<int>(picture.step[0]), picture.rows,
                  TJPF_BGR, &data, &size, TJSAMP_420, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0)
    throw std::invalid_argument(tjGetErrorStr2(jpeg.get()));
  bytes.resize(size);
  return bytes;
}

}  // namespace stereobench::renderer
