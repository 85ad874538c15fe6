#include "harness/rig_calibration/board_corners.h"

#include <algorithm>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace stereobench::harness {
namespace {

constexpr double kWindow = 0.3;        // half width of the window, of the shortest side of a square
constexpr int kSmallestWindow_px = 2;  // half width; 5 x 5 pixels

/// The least distance of two corners that are neighbours.
double shortest_side_px(const std::vector<cv::Point2f>& corners, const Board& board) {
  double shortest = 1e9;
  const auto distance = [&](int a, int b) {
    return cv::norm(corners[static_cast<std::size_t>(a)] - corners[static_cast<std::size_t>(b)]);
  };
  for (int i = 0; i < board.corners(); ++i) {
    if (i % board.columns + 1 < board.columns) shortest = std::min(shortest, distance(i, i + 1));
    if (i + board.columns < board.corners()) shortest = std::min(shortest, distance(i, i + board.columns));
  }
  return shortest;
}

cv::Mat grey_of(const cv::Mat& picture) {
  if (picture.channels() == 1) return picture;
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> find_corners(const cv::Mat& picture, const Board& board) {
  const cv::Mat grey = grey_of(picture);
  std::vector<cv::Point2f> corners;
  if (std::min(grey.cols, grey.rows) < 16) return std::nullopt;  // OpenCV's own filters need some pixels
  if (!cv::findChessboardCorners(grey, {board.columns, board.rows}, corners)) return std::nullopt;
  const int half = std::max(kSmallestWindow_px, static_cast<int>(kWindow * shortest_side_px(corners, board)));
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2f& corner : corners) result.emplace_back(corner.x, corner.y);
  return result;
}

void align_orders(BoardView& view) {
  auto& [left, right] = view.corners_px;
  if ((left.back() - left.front()).dot(right.back() - right.front()) < 0.0)
    std::reverse(right.begin(), right.end());
}

}  // namespace stereobench::harness
