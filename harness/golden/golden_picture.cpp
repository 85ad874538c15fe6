#include "harness/golden/golden_picture.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/report/canvas.h"
#include "harness/report/detection_picture.h"

namespace stereobench::harness {
namespace {

constexpr int kPanelWidth_px = 512;
constexpr int kGap_px = 8;
constexpr int kLine_px = 20;
constexpr int kMostGain = 64;
constexpr TextStyle kTitle = {.size_px = 16.0, .bold = true};
constexpr TextStyle kText = {.size_px = 13.0};

/// What differs in a picture, made brighter.
cv::Mat differences_on_dim_picture(const cv::Mat& before, const cv::Mat& after, int gain) {
  cv::Mat differences, dim;
  cv::absdiff(before, after, differences);
  cv::cvtColor(before, dim, cv::COLOR_BGR2GRAY);
  cv::cvtColor(dim, dim, cv::COLOR_GRAY2BGR);
  return dim * 0.25 + differences * gain;
}

/// Pixels are enlarged as squares, so that single ones can be seen.
cv::Mat enlarged(const cv::Mat& picture, const cv::Size& size) {
  cv::Mat large;
  cv::resize(picture, large, size, 0.0, 0.0, cv::INTER_NEAREST);
  return large;
}

vision::StereoPair shown_on_screen(const GoldenFrame& frame) {
  worlds::CameraSensor camera;
  if (!frame.is_linear) camera.encoding = worlds::Encoding::kSrgb;
  return for_display({frame.left.colour, frame.right.colour}, camera);
}

int gain_of(const GoldenDifference& difference) {
  const int most = std::max(difference.left.most_levels, difference.right.most_levels);
  return std::clamp(4 * 255 / std::max(most, 1), 1, kMostGain);  // a quarter of the largest is bright already
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Breaks a line between words where it gets wider than the sheet.
std::vector<std::string> wrapped(const Canvas& canvas, const std::string& line, double width_px) {
  std::istringstream words(line);
  std::vector<std::string> lines(1);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back() + (lines.back().empty() ? "" : " ") + word;
    if (canvas.text_width_px(longer, kText) > width_px && !lines.back().empty())
      lines.push_back("    " + word);
    else
      lines.back() = longer;
  }
  return lines;
}

std::vector<std::string> story_of(const GoldenDifference& difference, double width_px) {
  const Canvas measure(1, 1);
  std::vector<std::string> story;
  for (const std::string& line : lines_of(difference_text(difference)))
    for (const std::string& part : wrapped(measure, line, width_px)) story.push_back(part);
  if (story.empty()) story.emplace_back("nothing changed");
  return story;
}

}  // namespace

std::string draw_golden_difference(const std::string& title, const GoldenFrame& before,
                                   const GoldenFrame& after, const GoldenDifference& difference) {
  if (before.left.colour.size() != after.left.colour.size())
    throw std::invalid_argument("golden frames that are drawn side by side are of one size");
  const cv::Size size = before.left.colour.size();
  const cv::Size panel(kPanelWidth_px, std::max(1, kPanelWidth_px * size.height / size.width));
  const int width_px = 3 * panel.width + 4 * kGap_px;
  const std::vector<std::string> story = story_of(difference, width_px - 2.0 * kGap_px);
  const int top_px = kLine_px * (static_cast<int>(story.size()) + 3);
  cv::Mat sheet(top_px + 2 * (panel.height + kGap_px), width_px, CV_8UC3, cv::Scalar::all(255));
  const vision::StereoPair was = shown_on_screen(before), is = shown_on_screen(after);
  const int gain = gain_of(difference);
  for (int row = 0; row < 2; ++row) {
    const GoldenPicture& old = row == 0 ? before.left : before.right;
    const GoldenPicture& now = row == 0 ? after.left : after.right;
    const std::array<cv::Mat, 3> panels = {row == 0 ? was.left : was.right, row == 0 ? is.left : is.right,
                                           differences_on_dim_picture(old.colour, now.colour, gain)};
    for (int column = 0; column < 3; ++column) {
      const cv::Rect place(kGap_px + column * (panel.width + kGap_px),
                           top_px + row * (panel.height + kGap_px), panel.width, panel.height);
      enlarged(panels.at(static_cast<std::size_t>(column)), panel).copyTo(sheet(place));
    }
  }
  Canvas canvas(sheet);
  canvas.write({kGap_px, 0.5 * kLine_px + 4.0},
               fmt::format("{}: {}", title, difference.passes ? "within its limits" : "beyond its limits"),
               kTitle);
  for (std::size_t i = 0; i < story.size(); ++i)
    canvas.write({kGap_px, kLine_px * (static_cast<double>(i) + 1.5) + 8.0}, story[i], kText);
  const std::array<std::string, 3> heads = {"before (left camera above, right camera below)", "after",
                                            fmt::format("difference x {}", gain)};
  for (std::size_t column = 0; column < heads.size(); ++column)
    canvas.write({kGap_px + static_cast<double>(column) * (panel.width + kGap_px), top_px - 0.5 * kLine_px},
                 heads[column], kText);
  return canvas.png();
}

}  // namespace stereobench::harness
