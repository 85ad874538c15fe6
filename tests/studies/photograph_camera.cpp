#include <algorithm>
#include <cmath>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "slam/math/random.h"
#include "tests/studies/photograph.h"

namespace stereobench::photograph {
namespace {

/// What a point becomes while the camera moves.
cv::Mat motion_kernel(const Eigen::Vector2d& way_px) {
  constexpr int kHalf = 4;
  constexpr int kSteps = 64;
  cv::Mat kernel = cv::Mat::zeros(2 * kHalf + 1, 2 * kHalf + 1, CV_32F);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector2d at = ((step + 0.5) / kSteps - 0.5) * way_px + Eigen::Vector2d(kHalf, kHalf);
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    const double right = at.x() - x, down = at.y() - y;
    const auto add = [&](int row, int column, double share) {
      if (share > 0.0) kernel.at<float>(row, column) += static_cast<float>(share / kSteps);
    };
    add(y, x, (1.0 - right) * (1.0 - down));
    add(y, x + 1, right * (1.0 - down));
    add(y + 1, x, (1.0 - right) * down);
    add(y + 1, x + 1, right * down);
  }
  return kernel;
}

/// IEC 61966-2-1.
double srgb(double light) {
  const double x = std::clamp(light, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace

cv::Mat expose(const cv::Mat& light, const Camera& camera, std::uint64_t seed) {
  cv::Mat blurred = light.clone();
  if (camera.motion_px.norm() > 0.0)
    cv::filter2D(blurred, blurred, CV_32F, motion_kernel(camera.motion_px), {-1, -1}, 0.0,
                 cv::BORDER_REPLICATE);
  cv::GaussianBlur(blurred, blurred, {}, camera.defocus_sd_px, camera.defocus_sd_px, cv::BORDER_REPLICATE);
  slam::RandomStream random(seed, slam::Stream::kImageNoise);
  cv::Mat levels(light.size(), CV_8UC3);
  for (int row = 0; row < levels.rows; ++row)
    for (int column = 0; column < levels.cols; ++column)
      for (int channel = 0; channel < 3; ++channel) {
        const double lit = camera.exposure * camera.balance_bgr[channel] *
                           static_cast<double>(blurred.at<cv::Vec3f>(row, column)[channel]);
        const double sd = camera.noise_sd_levels / 255.0 * std::sqrt(0.1 + 2.0 * std::min(lit, 1.0));
        levels.at<cv::Vec3b>(row, column)[channel] =
            cv::saturate_cast<std::uint8_t>(std::lround(255.0 * srgb(lit + sd * random.normal())));
      }
  std::vector<std::uint8_t> bytes;  // OpenCV's encoder halves the colours
  cv::imencode(".jpg", levels, bytes, {cv::IMWRITE_JPEG_QUALITY, camera.jpeg_quality});
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

Photograph take(std::uint64_t seed) {
  Photograph photograph;
  const cv::Mat light = paint(scene_of(seed), photograph.balls);
  photograph.levels = expose(light, camera_of(seed), seed);
  return photograph;
}

}  // namespace stereobench::photograph
