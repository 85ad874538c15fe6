#include "renderer/camera/picture_pool.h"

#include <algorithm>
#include <atomic>

namespace stereobench::renderer {
namespace {

/// Whether the pool is the last one that knows a picture. Others may drop theirs on another thread.
bool is_idle(const cv::Mat& picture) {
  return std::atomic_ref(picture.u->refcount).load(std::memory_order_acquire) == 1;
}

}  // namespace

cv::Mat PicturePool::take(const cv::Size& size_px, int type) {
  const auto fits = [&](const cv::Mat& picture) {
    return picture.size() == size_px && picture.type() == type && !picture.empty() && is_idle(picture);
  };
  const auto found = std::find_if(given_.begin(), given_.end(), fits);
  if (found != given_.end()) return *found;
  cv::Mat& slot = given_[oldest_];
  oldest_ = (oldest_ + 1) % given_.size();
  return slot = cv::Mat(size_px, type);
}

}  // namespace stereobench::renderer
