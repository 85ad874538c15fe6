#include "harness/preview/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/io/file_list.h"
#include "harness/io/json_file.h"
#include "harness/report/canvas.h"
#include "harness/report/detection_picture.h"

namespace stereobench::harness {
namespace {

using vision::Side;

constexpr int kGap_px = 8;
constexpr int kTitle_px = 44;  ///< above the rows: the name, and what columns hold
constexpr int kLabel_px = 20;  ///< above each row: the frame's name
constexpr std::array kWidths_px = {320, 256, 200, 160, 120, 80, 48};

/// What a frame's channel holds. @return empty where there is none
cv::Mat channel_of(const ViewFrame& frame, Side side, Channel channel) {
  const ChannelFile* const file = find_channel(frame, side, channel);
  return file == nullptr ? cv::Mat() : file->read();
}

cv::Mat in_colours(const cv::Mat& picture) {
  if (picture.channels() != 1) return picture;
  cv::Mat bgr;
  cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

/// A frame of the sheet; what it has not is empty.
struct SheetRow {
  std::string name;
  vision::StereoPair pair;
  cv::Mat nearness;  ///< CV_32FC1: disparity in px, or 1 / depth in 1 / m; +inf = none
  cv::Mat ball_id;
};

/// What rows of a sheet have in common.
struct SheetColumns {
  bool has_right = false;
  bool has_nearness = false;
  bool is_disparity = false;
  bool has_balls = false;
  float most = 0.0F;  ///< of the nearness, of all rows
};

/// 1 / depth; none stays none.
cv::Mat inverse_of(const cv::Mat& depth_m) {
  cv::Mat inverse = 1.0 / depth_m;
  inverse.setTo(std::numeric_limits<double>::infinity(), inverse == 0.0);
  return inverse;
}

SheetRow read_row(const ViewFrame& frame, worlds::Encoding encoding) {
  SheetRow row = {.name = frame.name,
                  .pair = shown_pair(frame, encoding),
                  .nearness = channel_of(frame, Side::kLeft, Channel::kDisparity),
                  .ball_id = channel_of(frame, Side::kLeft, Channel::kBallId)};
  if (row.nearness.empty())
    if (const cv::Mat depth_m = channel_of(frame, Side::kLeft, Channel::kDepth); !depth_m.empty())
      row.nearness = inverse_of(depth_m);
  return row;
}

/// The largest value that there is; 0 where there is none.
float most_of(const cv::Mat& nearness) {
  double most = 0.0;
  cv::minMaxLoc(nearness, nullptr, &most, nullptr, nullptr,
                nearness < std::numeric_limits<float>::infinity());
  return static_cast<float>(std::max(most, 0.0));
}

SheetColumns columns_of(const DatasetView& view, const std::vector<std::size_t>& frames,
                        const std::vector<SheetRow>& rows) {
  SheetColumns columns;
  for (const std::size_t frame : frames)
    columns.is_disparity |= find_channel(view.frames[frame], Side::kLeft, Channel::kDisparity) != nullptr;
  for (const SheetRow& row : rows) {
    columns.has_right |= !row.pair.right.empty();
    columns.has_nearness |= !row.nearness.empty();
    columns.has_balls |= !row.ball_id.empty();
    if (!row.nearness.empty()) columns.most = std::max(columns.most, most_of(row.nearness));
  }
  return columns;
}

/// The size of a cell. @param picture that of the left camera
cv::Size cell_size(const cv::Size& picture, int width_px) {
  return {width_px, std::max(1, width_px * picture.height / picture.width)};
}

/// Near is red, far is blue, none is black.
cv::Mat nearness_picture(const cv::Mat& nearness, float most) {
  const cv::Mat none = nearness == std::numeric_limits<float>::infinity();
  cv::Mat levels, colours;
  nearness.convertTo(levels, CV_8U, most > 0.0F ? 255.0 / static_cast<double>(most) : 0.0);
  cv::applyColorMap(levels, colours, cv::COLORMAP_TURBO);
  colours.setTo(cv::Scalar::all(0), none);
  return colours;
}

/// A colour for each ball, its neighbours' far away on the circle of hues.
cv::Vec3b colour_of(int id) {
  constexpr int kHues = 180, kStep = 68;  // OpenCV's hues; the step is near the golden section's
  cv::Mat bgr, hsv(1, 1, CV_8UC3, cv::Scalar(id * kStep % kHues, 200, 255));
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return bgr.at<cv::Vec3b>(0);
}

/// Balls in colours on what is left of the picture.
cv::Mat ball_picture(const cv::Mat& ball_id, const cv::Mat& picture) {
  cv::Mat shown;
  cv::cvtColor(picture, shown, cv::COLOR_BGR2GRAY);
  shown = in_colours(0.4 * shown);
  for (int id = 1; id < 256; ++id) {
    const cv::Mat is_ball = ball_id == id;
    if (cv::countNonZero(is_ball) > 0) shown.setTo(cv::Scalar(colour_of(id)), is_ball);
  }
  return shown;
}

/// A picture in the width of the sheet, without the noise that PNG cannot pack: five bits a channel look the
/// same.
cv::Mat photograph(const cv::Mat& picture, int width_px) {
  if (picture.empty()) return picture;
  cv::Mat small;
  cv::resize(picture, small, cell_size(picture.size(), width_px), 0, 0, cv::INTER_AREA);
  cv::bitwise_and(small, cv::Scalar::all(0xF8), small);
  return small;
}

/// The pictures of a row, left to right; empty ones where the row has none.
std::vector<cv::Mat> cells_of(const SheetRow& row, const SheetColumns& columns, int width_px) {
  std::vector<cv::Mat> cells = {photograph(row.pair.left, width_px)};
  if (columns.has_right) cells.push_back(photograph(row.pair.right, width_px));
  if (columns.has_nearness)
    cells.push_back(row.nearness.empty() ? cv::Mat() : nearness_picture(row.nearness, columns.most));
  if (columns.has_balls)
    cells.push_back(row.ball_id.size() == row.pair.left.size()
                        ? photograph(ball_picture(row.ball_id, row.pair.left), width_px)
                        : cv::Mat());
  return cells;
}

std::vector<std::string> titles_of(const SheetColumns& columns) {
  std::vector<std::string> titles = {"left"};
  if (columns.has_right) titles.emplace_back("right");
  if (columns.has_nearness && columns.is_disparity)
    titles.push_back(fmt::format("disparity, dark red is {:.1f} px, black is none", columns.most));
  else if (columns.has_nearness)
    titles.push_back(fmt::format("depth, dark red is {:.2f} m, black is none", 1.0F / columns.most));
  if (columns.has_balls) titles.emplace_back("balls");
  return titles;
}

class Sheet {
 public:
  Sheet(std::size_t columns, std::size_t rows, const cv::Size& cell)
      : cell_(cell),
        picture_(kTitle_px + static_cast<int>(rows) * (kLabel_px + cell.height) + kGap_px,
                 kGap_px + static_cast<int>(columns) * (cell.width + kGap_px), CV_8UC3,
                 cv::Scalar::all(255)) {}

  void put(std::size_t row, std::size_t column, const cv::Mat& picture) {
    const cv::Rect place(left_px(column), top_px(row), cell_.width, cell_.height);
    cv::Mat small(cell_, CV_8UC3, cv::Scalar::all(225));
    if (!picture.empty()) cv::resize(picture, small, cell_, 0, 0, cv::INTER_AREA);
    small.copyTo(picture_(place));
  }
  int left_px(std::size_t column) const {
    return kGap_px + static_cast<int>(column) * (cell_.width + kGap_px);
  }
  int top_px(std::size_t row) const {
    return kTitle_px + kLabel_px + static_cast<int>(row) * (kLabel_px + cell_.height);
  }
  const cv::Mat& picture() const { return picture_; }

 private:
  cv::Size cell_;
  cv::Mat picture_;
};

/// Text no wider than its column: smaller, where it would be.
void write_within(Canvas& canvas, const Point& at, const std::string& text, TextStyle style, double most_px) {
  const double width_px = canvas.text_width_px(text, style);
  if (width_px > most_px) style.size_px *= most_px / width_px;
  canvas.write(at, text, style);
}

std::string drawn(const std::vector<SheetRow>& rows, const SheetColumns& columns, const std::string& name,
                  int width_px) {
  const std::vector<std::string> titles = titles_of(columns);
  Sheet sheet(titles.size(), rows.size(), cell_size(rows.front().pair.left.size(), width_px));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::vector<cv::Mat> cells = cells_of(rows[row], columns, width_px);
    for (std::size_t column = 0; column < cells.size(); ++column) sheet.put(row, column, cells[column]);
  }
  Canvas canvas(sheet.picture());
  const double whole_px = sheet.picture().cols - 2.0 * kGap_px;
  write_within(canvas, {kGap_px, 14.0}, name, {.size_px = 14.0, .bold = true}, whole_px);
  for (std::size_t column = 0; column < titles.size(); ++column)
    write_within(canvas, {static_cast<double>(sheet.left_px(column)), 36.0}, titles[column], {}, width_px);
  for (std::size_t row = 0; row < rows.size(); ++row)
    write_within(canvas, {kGap_px, sheet.top_px(row) - 0.5 * kLabel_px},
                 fmt::format("frame {}", rows[row].name), {.size_px = 11.0}, whole_px);
  return canvas.png();
}

}  // namespace

std::vector<std::size_t> evenly_spaced(std::size_t all, std::size_t count) {
  const std::size_t some = std::min(all, count);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < some; ++i)
    indices.push_back(some == 1 ? 0 : (2 * i * (all - 1) + some - 1) / (2 * (some - 1)));
  return indices;
}

worlds::Encoding shown_encoding(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / kDatasetJson)) return worlds::Encoding::kSrgb;
  return read_json_file(folder / kDatasetJson, [](const JsonValue& json) {
    const auto drive = json.find("drive");
    const auto encoding = drive ? drive->find("encoding") : std::nullopt;
    return encoding && encoding->text() == "linear" ? worlds::Encoding::kLinear : worlds::Encoding::kSrgb;
  });
}

vision::StereoPair shown_pair(const ViewFrame& frame, worlds::Encoding encoding) {
  const cv::Mat left = channel_of(frame, Side::kLeft, Channel::kPicture);
  const cv::Mat right = channel_of(frame, Side::kRight, Channel::kPicture);
  if (left.empty()) throw std::runtime_error(fmt::format("frame {}: has no left picture", frame.name));
  const cv::Mat shown_left = in_colours(left), shown_right = right.empty() ? right : in_colours(right);
  vision::StereoPair shown =
      for_display({shown_left, shown_right.empty() ? shown_left : shown_right}, {.encoding = encoding});
  if (right.empty()) shown.right.release();
  return shown;
}

std::string contact_sheet(const DatasetView& view, const std::vector<std::size_t>& frames,
                          const std::string& name) {
  const worlds::Encoding encoding = shown_encoding(view.folder);
  std::vector<SheetRow> rows;
  for (const std::size_t frame : frames) rows.push_back(read_row(view.frames[frame], encoding));
  const SheetColumns columns = columns_of(view, frames, rows);
  std::string png;
  for (const int width_px : kWidths_px) {
    png = drawn(rows, columns, name, width_px);
    if (png.size() <= kMostSheetBytes) return png;
  }
  throw std::runtime_error(fmt::format("--frames: a sheet of {} pairs weighs more than {} bytes; take fewer",
                                       frames.size(), kMostSheetBytes));
}

}  // namespace stereobench::harness
