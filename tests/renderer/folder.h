/// Where tests put their files.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "renderer/pictures/png_picture.h"

namespace stereobench::renderer::test {

/// A folder that nobody else has, removed with what is in it at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "stereobench_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder for a test");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// @return the file's path
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  /// As PNG.
  std::string write(const std::string& name, const cv::Mat& picture) const {
    const std::vector<std::uint8_t> png = encode_png(picture);
    return write(name, std::string(png.begin(), png.end()));
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One for files that worlds name and others read later.
inline const Folder& folder_of_this_process() {
  static const Folder folder;
  return folder;
}

}  // namespace stereobench::renderer::test
