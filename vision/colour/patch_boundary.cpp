#include "vision/colour/patch_boundary.h"

#include <algorithm>
#include <cstdint>

namespace stereobench::vision {
namespace {

// The first and last pixel that has the patch's colour, of a row or a column.
struct PixelSpan {
  int first = 0;
  int last = -1;

  void add(int place) {
    if (last < first) first = place;
    first = std::min(first, place);
    last = std::max(last, place);
  }
};

}  // namespace

ScratchVector<Eigen::Vector2d> patch_boundary(const cv::Mat& image, const Blob& blob,
                                              const ColourTable& table) {
  ScratchVector<PixelSpan> rows(static_cast<std::size_t>(blob.max_y - blob.min_y + 1));
  ScratchVector<PixelSpan> columns(static_cast<std::size_t>(blob.max_x - blob.min_x + 1));
  for (int y = blob.min_y; y <= blob.max_y; ++y) {
    const auto* bgr = image.ptr<std::uint8_t>(y) + 3 * blob.min_x;
    for (int x = blob.min_x; x <= blob.max_x; ++x, bgr += 3) {
      if (table.classify(bgr[0], bgr[1], bgr[2]) != blob.colour) continue;
      rows[static_cast<std::size_t>(y - blob.min_y)].add(x);
      columns[static_cast<std::size_t>(x - blob.min_x)].add(y);
    }
  }
  ScratchVector<Eigen::Vector2d> points;
  for (int y = blob.min_y; y <= blob.max_y; ++y) {
    const PixelSpan& row = rows[static_cast<std::size_t>(y - blob.min_y)];
    if (row.last < row.first) continue;
    if (row.first > 0) points.emplace_back(row.first - 0.5, y);
    if (row.last < image.cols - 1) points.emplace_back(row.last + 0.5, y);
  }
  for (int x = blob.min_x; x <= blob.max_x; ++x) {
    const PixelSpan& column = columns[static_cast<std::size_t>(x - blob.min_x)];
    if (column.last < column.first) continue;
    if (column.first > 0) points.emplace_back(x, column.first - 0.5);
    if (column.last < image.rows - 1) points.emplace_back(x, column.last + 0.5);
  }
  return points;
}

}  // namespace stereobench::vision
