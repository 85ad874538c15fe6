#include "harness/dataset/formats/dataset_writer.h"

#include <filesystem>
#include <utility>

#include "harness/io/picture_file.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {

DatasetFile picture_file(std::string name, std::function<cv::Mat()> picture) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return {std::move(name),
          [extension, picture = std::move(picture)] { return encoded(extension, picture()); }};
}

DatasetFile picture_file(std::string name, const cv::Mat& picture) {
  return picture_file(std::move(name), [picture] { return picture; });
}

DatasetFile camera_file(std::string name, DatasetPair& pair, vision::Side side) {
  if (const auto file = pair.file_of(side)) return {std::move(name), [file] { return read_text(*file); }};
  return picture_file(std::move(name), [side, &pair] { return pair.picture(side); });
}

DatasetFile text_file(std::string name, std::string text) {
  return {std::move(name), [text = std::move(text)] { return text; }};
}

std::vector<DatasetContainer> DatasetWriter::containers(const MeasurementLog&) const {
  return {};
}

}  // namespace stereobench::harness
