#include "harness/dataset/picture_reader.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <unistd.h>

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// What is written to stderr while it lives: libraries of picture formats complain there, and nowhere else.
class CapturedErrors {
 public:
  CapturedErrors() : file_(std::tmpfile()), before_(::dup(STDERR_FILENO)) {
    std::fflush(stderr);
    if (file_ != nullptr) ::dup2(::fileno(file_), STDERR_FILENO);
  }
  ~CapturedErrors() {
    std::fflush(stderr);
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
    if (file_ != nullptr) std::fclose(file_);
  }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  std::string text() const {
    std::string text(4096, '\0');
    std::fflush(stderr);
    if (file_ == nullptr) return {};
    std::rewind(file_);
    text.resize(std::fread(text.data(), 1, text.size(), file_));
    return text;
  }

 private:
  std::FILE* file_;
  int before_;
};

[[noreturn]] void refuse(const fs::path& file, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

cv::Mat decode(const fs::path& file) {
  const CapturedErrors errors;
  cv::Mat picture;
  try {
    picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // of a picture that is too large
    refuse(file, "is no picture that can be read");
  }
  // A JPEG that is cut short is filled up with grey, and mentioned.
  const bool cut = errors.text().find("remature end") != std::string::npos;
  if (picture.empty() || cut) refuse(file, "is no whole picture");
  return picture;
}

/// 8 bits a channel, without transparency.
cv::Mat read_levels(const fs::path& file) {
  if (!fs::exists(file)) refuse(file, "no such file");
  if (fs::is_directory(file)) refuse(file, "expected a picture (got a folder)");
  cv::Mat picture = decode(file);
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1.0 / 257.0);
  if (picture.depth() != CV_8U) refuse(file, "expected 8 or 16 bits a channel");
  if (picture.channels() == 4) cv::cvtColor(picture, picture, cv::COLOR_BGRA2BGR);
  return picture;
}

}  // namespace

cv::Mat read_picture(const fs::path& file) {
  cv::Mat picture = read_levels(file);
  if (picture.channels() != 3) refuse(file, "has no colour, by which balls are found");
  return picture;
}

cv::Mat read_grey_picture(const fs::path& file) {
  cv::Mat picture = read_levels(file);
  if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_BGR2GRAY);
  if (picture.channels() != 1) refuse(file, "expected a picture with 1, 3 or 4 channels");
  return picture;
}

bool is_picture_name(const fs::path& file) {
  constexpr std::array<std::string_view, 9> kExtensions = {".png",  ".jpg", ".jpeg", ".bmp", ".tif",
                                                           ".tiff", ".ppm", ".pgm",  ".pnm"};
  std::string extension = file.extension().string();
  for (char& letter : extension)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace stereobench::harness
