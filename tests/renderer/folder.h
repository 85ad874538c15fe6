/// Where tests put their files.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/pictures/png_picture.h"
#include "tests/test_folder.h"

namespace stereobench::renderer::test {

/// A folder that takes pictures as well.
class Folder : public TestFolder {
 public:
  using TestFolder::write;
  /// As PNG.
  std::filesystem::path write(const std::string& name, const cv::Mat& picture) const {
    const std::vector<std::uint8_t> png = encode_png(picture);
    return write(name, std::string(png.begin(), png.end()));
  }
};

/// One for files that worlds name and others read later.
inline const Folder& folder_of_this_process() {
  static const Folder folder;
  return folder;
}

}  // namespace stereobench::renderer::test
