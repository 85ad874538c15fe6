#include "harness/dataset/colour_marks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "harness/io/json_file.h"
#include "harness/io/picture_reader.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kMost_px = 1e5;
constexpr std::size_t kMostMarks = 100000;

/// A mark: all pixels whose centres lie within a circle or a box.
struct Mark {
  std::string picture;
  std::string colour;
  bool is_circle = false;
  std::vector<double> numbers;  ///< centre x, y, radius; or left, top, width, height

  bool contains(double x, double y) const {
    if (!is_circle)
      return x >= numbers[0] && x <= numbers[0] + numbers[2] && y >= numbers[1] &&
             y <= numbers[1] + numbers[3];
    const double dx = x - numbers[0];
    const double dy = y - numbers[1];
    return dx * dx + dy * dy <= numbers[2] * numbers[2];
  }
};

Mark read_mark(const JsonValue& value) {
  value.allow({"picture", "colour", "circle_px", "box_px"});
  Mark mark{value.at("picture").text(), value.at("colour").text()};
  const auto circle = value.find("circle_px");
  const auto box = value.find("box_px");
  if (circle.has_value() == box.has_value()) value.refuse("either circle_px or box_px");
  if (mark.colour.empty()) value.at("colour").refuse("a name");
  mark.is_circle = circle.has_value();
  const std::size_t count = mark.is_circle ? 3 : 4;
  for (const JsonValue& number : (mark.is_circle ? *circle : *box).list(count, count))
    mark.numbers.push_back(number.number(mark.numbers.size() < 2 ? -kMost_px : 0.0, kMost_px));
  return mark;
}

std::vector<Mark> read_marks(const fs::path& file) {
  return read_json_file(file, [](const JsonValue& value) {
    value.allow({"marks"});
    std::vector<Mark> marks;
    for (const JsonValue& entry : value.at("marks").list(1, kMostMarks)) marks.push_back(read_mark(entry));
    return marks;
  });
}

std::size_t add_pixels(const cv::Mat& levels, const Mark& mark, std::vector<Eigen::Vector3d>& pixels) {
  const std::size_t before = pixels.size();
  for (int row = 0; row < levels.rows; ++row)
    for (int column = 0; column < levels.cols; ++column) {
      if (!mark.contains(column, row)) continue;
      const cv::Vec3b& bgr = levels.at<cv::Vec3b>(row, column);
      pixels.emplace_back(bgr[0], bgr[1], bgr[2]);
    }
  return pixels.size() - before;
}

}  // namespace

MarkedPixels read_marked_pixels(const fs::path& file, const std::string& encoding) {
  MarkedPixels marked;
  std::map<std::string, cv::Mat> pictures;
  std::vector<fs::path> files;
  for (const Mark& mark : read_marks(file)) {
    cv::Mat& levels = pictures[mark.picture];
    if (levels.empty()) {
      files.push_back(file.parent_path() / mark.picture);
      levels = read_picture(files.back());
    }
    if (!marked.pixels.contains(mark.colour)) marked.colours.push_back(mark.colour);
    if (add_pixels(levels, mark, marked.pixels[mark.colour]) == 0)
      throw std::runtime_error(fmt::format("{}: a mark of '{}' holds no pixel of {}", file.string(),
                                           excerpt(mark.colour), excerpt(mark.picture)));
  }
  marked.encoding = encoding_of(encoding, files);
  return marked;
}

}  // namespace stereobench::harness
