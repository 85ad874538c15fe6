#include "harness/dataset/formats/dataset_writer.h"

#include <filesystem>
#include <utility>

#include "harness/io/picture_file.h"

namespace stereobench::harness {

DatasetFile picture_file(std::string name, std::function<cv::Mat()> picture) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return {std::move(name),
          [extension, picture = std::move(picture)] { return encoded(extension, picture()); }};
}

DatasetFile picture_file(std::string name, const cv::Mat& picture) {
  return picture_file(std::move(name), [picture] { return picture; });
}

DatasetFile text_file(std::string name, std::string text) {
  return {std::move(name), [text = std::move(text)] { return text; }};
}

}  // namespace stereobench::harness
