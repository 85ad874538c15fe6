#include "renderer/truth/id_buffer.h"

#include <algorithm>
#include <cmath>

namespace stereobench::renderer {

std::array<int, 4> facets_around(const cv::Mat& facets, const Eigen::Vector2d& place_px) {
  const auto near = [](double coordinate, int size) {
    const int low = static_cast<int>(std::floor(coordinate));
    return std::array{std::clamp(low, 0, size - 1), std::clamp(low + 1, 0, size - 1)};
  };
  const auto [left, right] = near(place_px.x(), facets.cols);
  const auto [above, below] = near(place_px.y(), facets.rows);
  return {facets.at<int>(above, left), facets.at<int>(above, right), facets.at<int>(below, left),
          facets.at<int>(below, right)};
}

}  // namespace stereobench::renderer
