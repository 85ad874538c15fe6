#include "harness/dataset/picture_file.h"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/dataset/atomic_file.h"

namespace stereobench::harness {

std::string encoded(const char* extension, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(extension, picture, bytes))
    throw std::runtime_error(fmt::format("cannot encode a picture as {}", extension));
  return {bytes.begin(), bytes.end()};
}

void write_once(const std::filesystem::path& path, const cv::Mat& picture) {
  if (!std::filesystem::exists(path)) write_file_atomically(path, encoded(path.extension().c_str(), picture));
}

}  // namespace stereobench::harness
