#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>

#include "renderer/pictures/picture_formats.h"

namespace stereobench::renderer {
namespace {

/// A file's numbers, one after the other: in figures, or in bytes.
class Numbers {
 public:
  explicit Numbers(PictureBytes bytes) : rest_(bytes) {}

  std::uint32_t in_figures() {
    skip_blanks();
    std::uint32_t value = 0;
    std::size_t figures = 0;
    for (; figures < rest_.size() && std::isdigit(rest_[figures]) != 0; ++figures) {
      if (value > 99'999'999) refuse_broken("it has a number without end");
      value = 10 * value + rest_[figures] - '0';
    }
    if (figures == 0) refuse_broken("a number is missing");
    rest_ = rest_.subspan(figures);
    return value;
  }
  std::uint32_t in_bytes(std::size_t size) {
    require(size);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8U | rest_[i];
    rest_ = rest_.subspan(size);
    return value;
  }
  void require(std::size_t bytes) const {
    if (rest_.size() < bytes) refuse_broken("it is cut short");
  }

 private:
  /// Spaces and lines, and comments from '#' to the end of a line.
  void skip_blanks() {
    const auto blank = [&](char letter) {
      if (letter == '#') comment_ = true;
      if (letter == '\n') comment_ = false;
      return comment_ || std::isspace(static_cast<unsigned char>(letter)) != 0;
    };
    std::size_t blanks = 0;
    while (blanks < rest_.size() && blank(static_cast<char>(rest_[blanks]))) ++blanks;
    rest_ = rest_.subspan(blanks);
  }

  PictureBytes rest_;
  bool comment_ = false;
};

}  // namespace

cv::Mat decode_pnm(PictureBytes bytes, int longest_px) {
  const char kind = static_cast<char>(bytes[1]);
  const bool figures = kind < '5', colour = kind == '3' || kind == '6';
  Numbers numbers(bytes.subspan(2));
  const std::uint32_t width = numbers.in_figures(), height = numbers.in_figures(),
                      most = numbers.in_figures();
  check_size(width, height, longest_px);
  if (most < 1 || most > 65535) refuse_broken("its largest number is not between 1 and 65535");
  const std::size_t size = most < 256 ? 1 : 2;
  const std::size_t levels = std::size_t{width} * height * (colour ? 3 : 1);
  if (!figures) numbers.in_bytes(1);  // one blank
  numbers.require(figures ? levels : size * levels);
  cv::Mat picture(static_cast<int>(height), static_cast<int>(width), colour ? CV_8UC3 : CV_8UC1);
  for (std::size_t i = 0; i < levels; ++i) {
    const std::uint32_t level = std::min(figures ? numbers.in_figures() : numbers.in_bytes(size), most);
    const std::size_t place = colour ? i - i % 3 + 2 - i % 3 : i;  // red comes first
    picture.data[place] = static_cast<std::uint8_t>((level * 255 + most / 2) / most);
  }
  return picture;
}

}  // namespace stereobench::renderer
