/// Pixels of a distorted picture, gathered from an undistorted one that is larger than a processor's caches.
#pragma once

#include <algorithm>
#include <cstdint>

#include <opencv2/core.hpp>

namespace stereobench::renderer {

/// Some rows of an undistorted picture.
struct UndistortedRows {
  const cv::Mat& pixels;
  int first_row = 0;  ///< in the whole picture, in which places are counted
};

/// How many places ahead what they name is asked for.
inline constexpr int kPlacesAhead = 64;

/// Places that a row of a distorted picture looks at, two for each of its pixels: OpenCV's fixed-point maps.
struct LightPlaces {
  const cv::Vec2s* pixels;         ///< columns and rows of the first of four pixels
  const std::uint16_t* fractions;  ///< of the ways to the next column and row
};

/// For each pixel the mean light of two places each in two rows of places, each between four pixels. Of 8
/// bits it is to the byte what cv::remap makes of the places (INTER_LINEAR) and cv::resize of that
/// (INTER_AREA); of 16 bits it is rounded once.
/// @tparam Level std::uint8_t or std::uint16_t
/// @param undistorted CV_8UC3 or CV_16UC3, with two columns to the right of every place
/// @param distorted `width` times blue, green, red
template <class Level>
void gather_light(const LightPlaces (&places)[2], const UndistortedRows& undistorted, Level* distorted,
                  int width);

/// For each place its pixel.
template <class Pixel>
void pick(const cv::Vec2s* places, const UndistortedRows& undistorted, Pixel* picked, int width) {
  const std::size_t step = undistorted.pixels.step1();
  const Pixel* origin =
      undistorted.pixels.ptr<Pixel>() - static_cast<std::ptrdiff_t>(step) * undistorted.first_row;
  const auto at = [&](const cv::Vec2s& place) {
    return origin + step * static_cast<std::size_t>(place[1]) + place[0];
  };
  for (int u = 0; u < width; ++u) {
    __builtin_prefetch(at(places[std::min(u + kPlacesAhead, width - 1)]));
    picked[u] = *at(places[u]);
  }
}

}  // namespace stereobench::renderer
