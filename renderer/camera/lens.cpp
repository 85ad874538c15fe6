#include "renderer/camera/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "renderer/camera/readback.h"
#include "renderer/camera/remap.h"
#include "vision/camera/distortion.h"
#include "vision/camera/pinhole_rig.h"
#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

constexpr int kOversampling = vision::kPinholeDensity;
static_assert(kOversampling == 2);  // gather_light gathers four places a pixel
constexpr int kMargin_px = 2;       // for the interpolation at the border

/// Where a row of a grid of `density` by `density` places a pixel looks in the pinhole's picture.
void look(const vision::StereoRig& rig, const vision::Intrinsics& pinhole, int density, int row,
          std::vector<cv::Vec2d>& places) {
  Eigen::Vector2d last = Eigen::Vector2d::Zero(), before = last;
  for (std::size_t column = 0; column < places.size(); ++column) {
    const Eigen::Vector2d pixel((static_cast<double>(column) + 0.5) / density - 0.5,
                                (row + 0.5) / density - 0.5);
    const Eigen::Vector2d distorted = vision::pixel_ray(rig.intrinsics, pixel).head<2>();
    std::optional<Eigen::Vector2d> found;
    if (column >= 2)
      found = vision::undistort(rig.distortion, distorted, 2.0 * last - before);  // it goes on so
    if (!found) found = vision::undistort(rig.distortion, distorted);
    if (!found) throw std::invalid_argument("Lens: the lens folds its picture");
    before = std::exchange(last, *found);
    const Eigen::Vector2d at = vision::project(pinhole, found->homogeneous());
    places[column] = {at.x(), at.y()};
  }
}

cv::Vec2s rounded(const cv::Vec2d& place) {
  return {static_cast<short>(std::lround(place[0])), static_cast<short>(std::lround(place[1]))};
}

/// The rows of the pinhole's picture that each row of the distorted one has places in.
std::vector<cv::Range> rows_of(const cv::Mat& places) {
  std::vector<cv::Range> rows;
  for (int first = 0; first < places.rows; first += kOversampling) {
    cv::Range seen(std::numeric_limits<int>::max(), 0);
    for (int row = first; row < first + kOversampling; ++row) {
      const auto* at = places.ptr<cv::Vec2s>(row);
      const auto [low, high] =
          std::minmax_element(at, at + places.cols, [](const auto& a, const auto& b) { return a[1] < b[1]; });
      seen = {std::min<int>(seen.start, (*low)[1]), std::max<int>(seen.end, (*high)[1])};
    }
    rows.push_back(seen);
  }
  return rows;
}

}  // namespace

vision::StereoRig pinhole_rig_of(const vision::StereoRig& rig) {
  const auto pinhole = vision::pinhole_rig(rig);
  if (!pinhole) throw std::invalid_argument("Lens: the lens folds its picture");
  if (!vision::can_be_drawn(pinhole->intrinsics))
    throw std::invalid_argument("Lens: it sees more than a pinhole camera can draw");
  return *pinhole;
}

Lens::Lens(const vision::StereoRig& rig)
    : pinhole_(pinhole_rig_of(rig)),
      light_places_(kOversampling * rig.intrinsics.height_px, kOversampling * rig.intrinsics.width_px,
                    CV_16SC2),
      light_fractions_(light_places_.size(), CV_16UC1),
      truth_places_(rig.intrinsics.height_px, rig.intrinsics.width_px, CV_16SC2) {
  std::vector<cv::Vec2d> places(static_cast<std::size_t>(light_places_.cols));
  for (int row = 0; row < light_places_.rows; ++row) {
    look(rig, pinhole_.intrinsics, kOversampling, row, places);
    cv::Mat light, at = light_places_.row(row), fractions = light_fractions_.row(row);
    cv::Mat(places, false).reshape(2, 1).convertTo(light, CV_32F);
    cv::convertMaps(light, cv::noArray(), at, fractions, CV_16SC2);
  }
  places.resize(static_cast<std::size_t>(truth_places_.cols));
  for (int row = 0; row < truth_places_.rows; ++row) {
    look(rig, pinhole_.intrinsics, 1, row, places);
    std::transform(places.begin(), places.end(), truth_places_.ptr<cv::Vec2s>(row), rounded);
  }
  rows_seen_ = rows_of(light_places_);
}

cv::Range Lens::rows_seen(const cv::Range& rows) const {
  cv::Range seen(pinhole_.intrinsics.height_px, 0);
  for (int row = rows.start; row < rows.end; ++row) {
    const cv::Range& of_row = rows_seen_[static_cast<std::size_t>(row)];
    seen = {std::min(seen.start, of_row.start), std::max(seen.end, of_row.end)};
  }
  return {std::max(seen.start - kMargin_px, 0),
          std::min(seen.end + kMargin_px + 1, pinhole_.intrinsics.height_px)};
}

RenderedImage Lens::distort(const RenderedImage& undistorted, int first_row, const cv::Range& rows,
                            PicturePool& pool) const {
  const cv::Size size(truth_places_.cols, rows.size());
  const bool is_fine = undistorted.colour.depth() == CV_16U;
  RenderedImage distorted =
      blank_frame(size, is_fine ? LightDepth::kSixteenBits : LightDepth::kEightBits, pool);
  const auto distort_row = [&](int v) {
    const int row = rows.start + v;
    const auto light = [&](int k) {
      const int dense = kOversampling * row + k;
      return LightPlaces{light_places_.ptr<cv::Vec2s>(dense), light_fractions_.ptr<std::uint16_t>(dense)};
    };
    if (is_fine)
      gather_light({light(0), light(1)}, {undistorted.colour, first_row},
                   distorted.colour.ptr<std::uint16_t>(v), size.width);
    else
      gather_light({light(0), light(1)}, {undistorted.colour, first_row}, distorted.colour.ptr(v),
                   size.width);
    const auto* truth = truth_places_.ptr<cv::Vec2s>(row);
    pick(truth, {undistorted.ball_id, first_row}, distorted.ball_id.ptr(v), size.width);
    pick(truth, {undistorted.depth_m, first_row}, distorted.depth_m.ptr<float>(v), size.width);
  };
  cv::parallel_for_({0, rows.size()}, [&](const cv::Range& part) {
    for (int v = part.start; v < part.end; ++v) distort_row(v);
  });
  return distorted;
}

}  // namespace stereobench::renderer
