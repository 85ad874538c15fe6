/// Memory for pictures, used again once nobody looks at them.
#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// The last pictures that were given out. Memory of a picture's size comes fresh from the kernel, page by
/// page and cleared: for all pictures of a frame that takes a quarter of the time of rendering it.
class PicturePool {
 public:
  /// @return a picture that nobody else looks at, with anything in it
  cv::Mat take(const cv::Size& size_px, int type);

 private:
  std::array<cv::Mat, 12> given_;  // those of two frames: who renders one may still look at the last
  std::size_t oldest_ = 0;
};

}  // namespace stereobench::renderer
