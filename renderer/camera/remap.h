/// Pixels of a distorted picture, gathered from an undistorted one that is larger than a processor's caches.
#pragma once

#include <algorithm>
#include <cstdint>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// Some rows of an undistorted picture.
struct UndistortedRows {
  const cv::Mat& pixels;
  int first_row = 0;  ///< in the whole picture, in which places are counted
};

/// How many places ahead pixels are prefetched.
inline constexpr int kPlacesAhead = 64;

/// Steps from one pixel to the next that places are rounded to.
inline constexpr int kPhases = 128;

/// Variances of a spread, in squared pixels: three pixels cannot have less at all places without weights
/// below 0, nor more.
inline constexpr double kLeastSpread = 0.25, kMostSpread = 0.75;
inline constexpr int kSpreads = 33;  ///< that are told apart between them

/// A place in an undistorted picture, to 1/kPhases of a pixel, and how far around it light is gathered.
struct PinholePlace {
  std::int16_t column, row;     ///< of the nearest pixel
  std::int8_t right_of, below;  ///< from its centre, in 1/kPhases of a pixel: -64 .. 63
  std::uint8_t across, down;    ///< number of the spread each way, from kLeastSpread
};

/// @param column_row within 32,000 pixels
/// @param spread variance each way, in squared pixels; clamped to what there is
PinholePlace place_at(const Eigen::Vector2d& column_row, const Eigen::Vector2d& spread);

/// For each place the light around it, of nine pixels: three each way, with weights of 1/128 whose mean is
/// the place and whose variance is the spread, to 1/128. So light that is linear in the picture is kept, and
/// the blur does not depend on where a place lies between pixels. The least spread is a quadratic B-spline's.
/// @tparam Level std::uint8_t or std::uint16_t
/// @param undistorted CV_8UC3 or CV_16UC3, with a pixel around every place and two to the right
/// @param distorted `width` times blue, green, red; rounded once
template <class Level>
void gather_light(const PinholePlace* places, const UndistortedRows& undistorted, Level* distorted,
                  int width);

/// For each place its nearest pixel.
template <class Pixel>
void pick(const PinholePlace* places, const UndistortedRows& undistorted, Pixel* picked, int width) {
  const std::size_t step = undistorted.pixels.step1();
  const Pixel* origin =
      undistorted.pixels.ptr<Pixel>() - static_cast<std::ptrdiff_t>(step) * undistorted.first_row;
  const auto at = [&](const PinholePlace& place) {
    return origin + static_cast<std::ptrdiff_t>(step) * place.row + place.column;
  };
  for (int u = 0; u < width; ++u) {
    __builtin_prefetch(at(places[std::min(u + kPlacesAhead, width - 1)]));
    picked[u] = *at(places[u]);
  }
}

}  // namespace stereobench::renderer
