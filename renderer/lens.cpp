#include "renderer/lens.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "vision/distortion.h"
#include "vision/rig.h"

namespace stereobench::renderer {
namespace {

constexpr int kOversampling = 2;
constexpr int kMargin_px = 2;      // for the interpolation at the border
constexpr int kLargest_px = 8192;  // of the pinhole's picture

/// Where a grid of `density` by `density` places a pixel looks in the pinhole's picture.
/// @return CV_64FC2
cv::Mat places_seen(const vision::StereoRig& rig, const vision::Intrinsics& pinhole, int density) {
  cv::Mat places(density * rig.camera.height_px, density * rig.camera.width_px, CV_64FC2);
  for (int row = 0; row < places.rows; ++row) {
    std::optional<Eigen::Vector2d> direction;
    for (int column = 0; column < places.cols; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / density - 0.5, (row + 0.5) / density - 0.5);
      const Eigen::Vector2d bent = vision::pixel_ray(rig.camera, pixel).head<2>();
      if (direction)
        direction = vision::undistort(rig.distortion, bent, *direction);  // its neighbour's is near
      if (!direction) direction = vision::undistort(rig.distortion, bent);
      if (!direction) throw std::invalid_argument("Lens: the lens folds its picture");
      const Eigen::Vector2d at = vision::project(pinhole, direction->homogeneous());
      places.at<cv::Vec2d>(row, column) = {at.x(), at.y()};
    }
  }
  return places;
}

cv::Mat rounded(const cv::Mat& places) {
  cv::Mat pixels(places.size(), CV_32SC2);
  for (int row = 0; row < places.rows; ++row) {
    for (int column = 0; column < places.cols; ++column) {
      const cv::Vec2d& at = places.at<cv::Vec2d>(row, column);
      pixels.at<cv::Vec2i>(row, column) = {static_cast<int>(std::lround(at[0])),
                                           static_cast<int>(std::lround(at[1]))};
    }
  }
  return pixels;
}

template <class Pixel>
cv::Mat picked(const cv::Mat& straight, const cv::Mat& places) {
  cv::Mat bent(places.size(), straight.type());
  for (int row = 0; row < bent.rows; ++row) {
    for (int column = 0; column < bent.cols; ++column) {
      const cv::Vec2i& at = places.at<cv::Vec2i>(row, column);
      bent.at<Pixel>(row, column) = straight.at<Pixel>(at[1], at[0]);
    }
  }
  return bent;
}

}  // namespace

vision::StereoRig pinhole_rig_of(const vision::StereoRig& rig) {
  const auto seen = vision::directions_seen(rig.distortion, rig.camera);
  if (!seen) throw std::invalid_argument("Lens: the lens folds its picture");
  vision::StereoRig pinhole = rig;
  pinhole.distortion = {};
  vision::Intrinsics& camera = pinhole.camera;
  camera.focal_px = kOversampling * rig.camera.focal_px;
  const Eigen::Vector2d first = (camera.focal_px * seen->min()).array().floor() - kMargin_px;
  const Eigen::Vector2d last = (camera.focal_px * seen->max()).array().ceil() + kMargin_px;
  const Eigen::Vector2d size = last - first;
  if (!(size.maxCoeff() < kLargest_px))
    throw std::invalid_argument("Lens: it sees more than a pinhole camera can draw");
  camera.cx_px = -first.x();
  camera.cy_px = -first.y();
  camera.width_px = static_cast<int>(size.x()) + 1;
  camera.height_px = static_cast<int>(size.y()) + 1;
  return pinhole;
}

Lens::Lens(const vision::StereoRig& rig) : pinhole_(pinhole_rig_of(rig)) {
  cv::Mat light;
  places_seen(rig, pinhole_.camera, kOversampling).convertTo(light, CV_32F);
  cv::convertMaps(light, cv::noArray(), light_places_, light_fractions_, CV_16SC2);
  truth_places_ = rounded(places_seen(rig, pinhole_.camera, 1));
}

cv::Range Lens::rows_seen(const cv::Range& rows) const {
  const cv::Mat places = light_places_.rowRange(rows.start * kOversampling, rows.end * kOversampling);
  int first = pinhole_.camera.height_px;
  int last = 0;
  for (int row = 0; row < places.rows; ++row) {
    for (int column = 0; column < places.cols; ++column) {
      const int seen = places.at<cv::Vec2s>(row, column)[1];
      first = std::min(first, seen);
      last = std::max(last, seen);
    }
  }
  return {std::max(first - kMargin_px, 0), std::min(last + kMargin_px + 1, pinhole_.camera.height_px)};
}

EyeFrame Lens::bend(const EyeFrame& straight, int first_row, const cv::Range& rows) const {
  const cv::Range dense_rows(rows.start * kOversampling, rows.end * kOversampling);
  const cv::Mat light = light_places_.rowRange(dense_rows) - cv::Scalar(0, first_row);
  const cv::Mat truth = truth_places_.rowRange(rows) - cv::Scalar(0, first_row);
  cv::Mat dense;
  cv::remap(straight.colour, dense, light, light_fractions_.rowRange(dense_rows), cv::INTER_LINEAR,
            cv::BORDER_REPLICATE);
  EyeFrame bent;
  cv::resize(dense, bent.colour, truth.size(), 0.0, 0.0, cv::INTER_AREA);
  bent.ball_id = picked<std::uint8_t>(straight.ball_id, truth);
  bent.depth_m = picked<float>(straight.depth_m, truth);
  return bent;
}

}  // namespace stereobench::renderer
