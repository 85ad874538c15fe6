#include "renderer/camera/lens.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>
#include <opencv2/core/utility.hpp>

#include "renderer/camera/readback.h"
#include "vision/camera/distortion.h"
#include "vision/camera/pinhole_rig.h"
#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

constexpr int kMargin_px = 2;  // for the neighbours of a place

/// Variances, in squared pixels of the pinhole's picture, of what a pixel gathers there: with that of the
/// pinhole's own pixels they make kBlur along the distorted picture's rows and columns.
/// @param slope d place / d direction
/// @param density pixels of the pinhole's picture for one where the lens does not distort
Eigen::Vector2d spread_of(const Eigen::Matrix2d& slope, double density) {
  constexpr double kOfAPixel = 1.0 / 12.0;  // variance of a square of light
  constexpr double kBlur =
      (kLeastSpread + kOfAPixel) / (vision::kLeastPinholeDensity * vision::kLeastPinholeDensity);
  const Eigen::Matrix2d pinhole_by_distorted = density * slope.inverse();
  return kBlur * pinhole_by_distorted.rowwise().squaredNorm().array() - kOfAPixel;
}

/// What the centres of a row's pixels see of the pinhole's picture.
std::vector<PinholePlace> places_of_row(const vision::StereoRig& rig, const vision::Intrinsics& pinhole,
                                        int row) {
  const double density = pinhole.focal_px / rig.intrinsics.focal_px;
  std::vector<PinholePlace> places;
  Eigen::Vector2d last = Eigen::Vector2d::Zero(), before = last;
  for (int column = 0; column < rig.intrinsics.width_px; ++column) {
    const Eigen::Vector2d distorted =
        vision::pixel_ray(rig.intrinsics, Eigen::Vector2d(column, row)).head<2>();
    std::optional<Eigen::Vector2d> found;
    if (column >= 2)
      found = vision::undistort(rig.distortion, distorted, 2.0 * last - before);  // it goes on so
    if (!found) found = vision::undistort(rig.distortion, distorted);
    if (!found) throw std::invalid_argument("Lens: the lens folds its picture");
    before = std::exchange(last, *found);
    const Eigen::Vector2d at = vision::project(pinhole, found->homogeneous());
    places.push_back(place_at(at, spread_of(vision::distortion_slope(rig.distortion, *found), density)));
  }
  return places;
}

/// The rows of the nearest pixels.
cv::Range rows_of(const std::vector<PinholePlace>& places) {
  const auto [low, high] =
      std::ranges::minmax_element(places, {}, [](const PinholePlace& place) { return place.row; });
  return {low->row, high->row + 1};
}

}  // namespace

vision::StereoRig pinhole_rig_of(const vision::StereoRig& rig) {
  const auto pinhole = vision::pinhole_rig(rig);
  if (!pinhole) throw std::invalid_argument("Lens: the lens folds its picture");
  if (!vision::can_be_drawn(pinhole->intrinsics))
    throw std::invalid_argument("Lens: it sees more than a pinhole camera can draw");
  return *pinhole;
}

Lens::Lens(const vision::StereoRig& rig) : pinhole_(pinhole_rig_of(rig)), width_px_(rig.intrinsics.width_px) {
  for (int row = 0; row < rig.intrinsics.height_px; ++row) {
    const std::vector<PinholePlace> places = places_of_row(rig, pinhole_.intrinsics, row);
    places_.insert(places_.end(), places.begin(), places.end());
    rows_seen_.push_back(rows_of(places));
  }
}

cv::Range Lens::rows_seen(const cv::Range& rows) const {
  cv::Range seen(pinhole_.intrinsics.height_px, 0);
  for (int row = rows.start; row < rows.end; ++row) {
    const cv::Range& of_row = rows_seen_[static_cast<std::size_t>(row)];
    seen = {std::min(seen.start, of_row.start), std::max(seen.end, of_row.end)};
  }
  return {std::max(seen.start - kMargin_px, 0),
          std::min(seen.end + kMargin_px, pinhole_.intrinsics.height_px)};
}

RenderedImage Lens::distort(const RenderedImage& undistorted, int first_row, const cv::Range& rows,
                            PicturePool& pool) const {
  const bool is_fine = undistorted.colour.depth() == CV_16U;
  RenderedImage distorted = blank_frame({width_px_, rows.size()},
                                        is_fine ? LightDepth::kSixteenBits : LightDepth::kEightBits, pool);
  const auto distort_row = [&](int v) {
    const PinholePlace* places = places_.data() + static_cast<std::ptrdiff_t>(width_px_) * (rows.start + v);
    const UndistortedRows light{undistorted.colour, first_row};
    if (is_fine)
      gather_light(places, light, distorted.colour.ptr<std::uint16_t>(v), width_px_);
    else
      gather_light(places, light, distorted.colour.ptr(v), width_px_);
    pick(places, {undistorted.ball_id, first_row}, distorted.ball_id.ptr(v), width_px_);
    pick(places, {undistorted.depth_m, first_row}, distorted.depth_m.ptr<float>(v), width_px_);
  };
  cv::parallel_for_({0, rows.size()}, [&](const cv::Range& part) {
    for (int v = part.start; v < part.end; ++v) distort_row(v);
  });
  return distorted;
}

}  // namespace stereobench::renderer
