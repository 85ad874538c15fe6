#include "harness/dataset/truth/truth_pictures.h"

#include <cmath>

namespace stereobench::harness {
namespace {

/// A picture of the results of a function of each pixel's column and row.
template <typename Pixel, typename Function>
cv::Mat picture(const cv::Size& size, Function pixel) {
  cv::Mat result(size, cv::traits::Type<Pixel>::value);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) result.at<Pixel>(v, u) = pixel(u, v);
  return result;
}

/// A number as a level of 16 bits; 0 when it does not fit.
std::uint16_t level_of(float value, float scale, float offset) {
  const float code = std::nearbyint(scale * value + offset);
  return code >= 1.0F && code <= 65535.0F ? static_cast<std::uint16_t>(code) : std::uint16_t{0};
}

}  // namespace

cv::Mat kitti_disparity(const cv::Mat& disparity_px) {
  return picture<std::uint16_t>(disparity_px.size(), [&](int u, int v) {
    return level_of(disparity_px.at<float>(v, u), 256.0F, 0.0F);
  });
}

cv::Mat kitti_shift(const renderer::Correspondence& found) {
  return picture<cv::Vec3w>(found.occlusion.size(), [&](int u, int v) {
    const cv::Vec2f shift = found.shift_px.at<cv::Vec2f>(v, u);
    const std::uint16_t red = level_of(shift[0], 64.0F, 32768.0F);
    const std::uint16_t green = level_of(shift[1], 64.0F, 32768.0F);
    const bool fits = red != 0 && green != 0;
    return fits ? cv::Vec3w(1, green, red) : cv::Vec3w(0, 0, 0);
  });
}

cv::Mat exact_shift(const renderer::Correspondence& found) {
  return picture<cv::Vec3f>(found.occlusion.size(), [&](int u, int v) {
    const cv::Vec2f shift = found.shift_px.at<cv::Vec2f>(v, u);
    const bool seen =
        found.occlusion.at<std::uint8_t>(v, u) == static_cast<std::uint8_t>(renderer::Occlusion::kSeen);
    return cv::Vec3f(seen ? 1.0F : 0.0F, shift[1], shift[0]);
  });
}

cv::Mat depth_levels(const cv::Mat& depth_m, double levels_per_metre) {
  const auto scale = static_cast<float>(levels_per_metre);
  return picture<std::uint16_t>(depth_m.size(),
                                [&](int u, int v) { return level_of(depth_m.at<float>(v, u), scale, 0.0F); });
}

cv::Mat normal_picture(const cv::Mat& normal) {
  return picture<cv::Vec3f>(normal.size(), [&](int u, int v) {
    const cv::Vec3f& xyz = normal.at<cv::Vec3f>(v, u);
    return cv::Vec3f(xyz[2], xyz[1], xyz[0]);
  });
}

}  // namespace stereobench::harness
