#include "harness/io/picture_reader.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "renderer/pictures/picture_reader.h"
#include "renderer/pictures/png_picture.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_picture(const fs::path& file, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// A file's picture. @param decode of its bytes
template <class Decode>
cv::Mat decoded(const fs::path& file, const Decode& decode) {
  if (!fs::exists(file)) refuse_picture(file, "no such file");
  if (fs::is_directory(file)) refuse_picture(file, "expected a picture (got a folder)");
  try {
    return decode(renderer::picture_bytes(file));
  } catch (const std::runtime_error& error) {
    refuse_picture(file, error.what());
  }
}

}  // namespace

cv::Mat read_levels(const fs::path& file) {
  return decoded(file, [](renderer::PictureBytes bytes) { return renderer::decode_picture(bytes); });
}

cv::Mat read_exact_png(const fs::path& file) {
  return decoded(file, [](renderer::PictureBytes bytes) { return renderer::decode_exact_png(bytes); });
}

cv::Mat read_picture(const fs::path& file) {
  cv::Mat picture = read_levels(file);
  if (picture.channels() != 3) refuse_picture(file, "has no colour, by which balls are found");
  return picture;
}

cv::Mat read_grey_picture(const fs::path& file) {
  cv::Mat picture = read_levels(file);
  if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_BGR2GRAY);
  return picture;
}

worlds::Encoding encoding_of(const std::string& asked, std::span<const fs::path> files) {
  if (asked != "auto") return asked == "srgb" ? worlds::Encoding::kSrgb : worlds::Encoding::kLinear;
  const auto is_srgb = [](const fs::path& file) {
    if (!fs::is_regular_file(file)) refuse_picture(file, "no such file");
    return renderer::said_of_levels(renderer::picture_bytes(file)) == renderer::SaidOfLevels::kSrgb;
  };
  for (const fs::path& file : files)
    if (is_srgb(file) != is_srgb(files.front()))
      throw std::runtime_error(fmt::format(
          "--encoding: {} and {} contradict each other, one is sRGB by its file and the other is not: say "
          "linear or srgb",
          files.front().string(), file.string()));
  return !files.empty() && is_srgb(files.front()) ? worlds::Encoding::kSrgb : worlds::Encoding::kLinear;
}

bool is_picture_name(const fs::path& file) {
  constexpr std::array<std::string_view, 10> kExtensions = {".png",  ".jpg", ".jpeg", ".bmp", ".tif",
                                                            ".tiff", ".ppm", ".pgm",  ".pnm", ".tga"};
  std::string extension = file.extension().string();
  for (char& letter : extension)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace stereobench::harness
