/// Pictures out of focus.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// A row of light, three channels a pixel.
using Row = std::vector<float>;

/// Copies a row of a picture, whatever its light is told in.
void take_row(const cv::Mat& light, int y, float* row);

/// The rows of a picture out of focus: blurred along rows, then along columns; beyond the border lies what is
/// at the border. OpenCV's blur of floats has other bits on other processors.
class Defocus {
 public:
  /// @param light outlives it
  Defocus(const cv::Mat& light, double sd_px);

  /// @param y each row in turn, from 0
  void take(int y, Row& row);

 private:
  /// The rows around the one that is asked for are kept, blurred along themselves.
  Row& across(int y) { return across_[static_cast<std::size_t>(y) % across_.size()]; }

  void blur_across(int y);

  const cv::Mat& light_;
  std::vector<float> weights_;
  std::size_t reach_;
  std::size_t size_;  ///< of a row
  Row wide_;          ///< a row with its border
  std::vector<Row> across_;
  int blurred_ = 0;  ///< rows along themselves so far
};

}  // namespace stereobench::renderer
