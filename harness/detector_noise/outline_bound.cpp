#include "harness/detector_noise/outline_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "vision/outline/outline_model.h"

namespace stereobench::harness {
namespace {

constexpr double kBlurReach = 4.0;  // standard deviations of a blurred edge
constexpr double kBeside_px = 1.5;  // of the outline, where a rim pixel's two colours are pure

Eigen::Vector3d colour_at(const cv::Mat& light, const Eigen::Vector2d& place) {
  const int x = std::clamp(static_cast<int>(std::lround(place.x())), 0, light.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(place.y())), 0, light.rows - 1);
  const auto* bgr = light.ptr<std::uint8_t>(y) + 3 * x;
  return {static_cast<double>(bgr[0]), static_cast<double>(bgr[1]), static_cast<double>(bgr[2])};
}

}  // namespace

Eigen::Matrix3d outline_information(const cv::Mat& light, const vision::Intrinsics& camera,
                                    const vision::OutlineEllipse& outline, const PictureQuality& quality) {
  const vision::OutlineModel model(camera, outline.centre_px, outline.radius_px(), quality.blur_px);
  const Eigen::Vector2d reach = outline.half_extent_px().array() + 1.0 + kBlurReach * quality.blur_px;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int y = static_cast<int>(outline.centre_px.y() - reach.y()); y <= outline.centre_px.y() + reach.y();
       ++y) {
    for (int x = static_cast<int>(outline.centre_px.x() - reach.x()); x <= outline.centre_px.x() + reach.x();
         ++x) {
      const Eigen::Vector2d pixel(x, y);
      const vision::RimPoint rim = model.rim_point(pixel);
      const double slope = model.coverage(rim).per_px;
      if (!(slope > 0.0)) continue;
      const Eigen::Vector2d on_rim = pixel - rim.distance_px * rim.normal;
      const Eigen::Vector3d contrast = colour_at(light, on_rim - kBeside_px * rim.normal) -
                                       colour_at(light, on_rim + kBeside_px * rim.normal);
      const Eigen::Vector3d outwards = rim.normal.homogeneous();
      information += slope * slope * contrast.squaredNorm() * outwards * outwards.transpose();
    }
  }
  return information / (quality.noise_sd_levels * quality.noise_sd_levels);
}

std::optional<Eigen::Matrix2d> outline_bound(const cv::Mat& light, const vision::Intrinsics& camera,
                                             const vision::OutlineEllipse& outline,
                                             const PictureQuality& quality) {
  const Eigen::Matrix2d information =
      outline_information(light, camera, outline, quality).topLeftCorner<2, 2>();
  if (!(information.determinant() > 0.0)) return std::nullopt;
  return information.inverse();
}

}  // namespace stereobench::harness
