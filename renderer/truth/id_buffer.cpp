#include "renderer/truth/id_buffer.h"

#include <algorithm>
#include <cmath>

namespace stereobench::renderer {

std::array<int, 4> primitives_around(const cv::Mat& primitives, const Eigen::Vector2d& place_px) {
  const auto near = [](double coordinate, int size) {
    const int low = static_cast<int>(std::floor(coordinate));
    return std::array{std::clamp(low, 0, size - 1), std::clamp(low + 1, 0, size - 1)};
  };
  const auto [left, right] = near(place_px.x(), primitives.cols);
  const auto [above, below] = near(place_px.y(), primitives.rows);
  return {primitives.at<int>(above, left), primitives.at<int>(above, right), primitives.at<int>(below, left),
          primitives.at<int>(below, right)};
}

}  // namespace stereobench::renderer
