#include "harness/golden/golden_difference.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/golden/ball_shift.h"
#include "renderer/surfaces/primitives.h"

namespace stereobench::harness {
namespace {

/// What surfaces are, seen alone. @return CV_8UC1, values of PixelPlace
cv::Mat kinds_of(const cv::Mat& shown, int first_mesh) {
  cv::Mat kinds(shown.size(), CV_8UC1);
  const auto kind_of = [first_mesh](int surface) {
    if (surface == renderer::kNoPrimitive) return PixelPlace::kBackground;
    if (renderer::is_ball(surface)) return PixelPlace::kBall;
    if (surface == renderer::kFloorPrimitive) return PixelPlace::kFloor;
    return surface < first_mesh ? PixelPlace::kWall : PixelPlace::kMesh;
  };
  for (int v = 0; v < shown.rows; ++v)
    for (int u = 0; u < shown.cols; ++u)
      kinds.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(kind_of(shown.at<std::uint16_t>(v, u)));
  return kinds;
}

/// The same, with the edges of balls: among a pixel and its eight neighbours, all of which are within 1.5 px,
/// there are a ball and something else.
cv::Mat places_in(const cv::Mat& shown, int first_mesh) {
  cv::Mat least, most, nearest_kind;
  const cv::Mat neighbours = cv::Mat::ones(3, 3, CV_8U);
  cv::erode(shown, least, neighbours);
  cv::dilate(shown, most, neighbours);
  cv::Mat kinds = kinds_of(shown, first_mesh);
  cv::erode(kinds, nearest_kind, neighbours);
  kinds.setTo(static_cast<int>(PixelPlace::kBallEdge),
              (least != most) & (nearest_kind == static_cast<int>(PixelPlace::kBall)));
  return kinds;
}

/// The largest difference of a channel at each pixel. @return CV_8UC1
cv::Mat levels_between(const cv::Mat& before, const cv::Mat& after) {
  cv::Mat differences;
  cv::absdiff(before, after, differences);
  cv::Mat channels[3], largest;
  cv::split(differences, channels);
  cv::max(channels[0], channels[1], largest);
  cv::max(largest, channels[2], largest);
  return largest;
}

PictureDifference compare_pictures(const GoldenPicture& before, const GoldenPicture& after,
                                   const GoldenLimits& limits, int first_mesh) {
  PictureDifference difference{.has_seen_the_same = before.seen_sha256 == after.seen_sha256,
                               .pixels = static_cast<long>(before.colour.total())};
  const cv::Mat levels = levels_between(before.colour, after.colour);
  const cv::Mat places = places_of(before.shown, after.shown, first_mesh);
  for (int v = 0; v < levels.rows; ++v) {
    for (int u = 0; u < levels.cols; ++u) {
      const int by = levels.at<std::uint8_t>(v, u);
      if (by > 0) ++difference.changed.at(places.at<std::uint8_t>(v, u));
      if (by > limits.levels) ++difference.beyond;
      difference.most_levels = std::max(difference.most_levels, by);
    }
  }
  difference.identities = cv::countNonZero(before.shown != after.shown);
  if (difference.all_changed() > 0) difference.shifts = ball_shifts(before, after);
  return difference;
}

bool is_within(const PictureDifference& difference, const GoldenLimits& limits) {
  if (difference.has_seen_the_same && difference.all_changed() == 0 && difference.identities == 0)
    return true;
  return !limits.are_exact() && difference.identities == 0 &&
         static_cast<double>(difference.beyond) <= limits.share * static_cast<double>(difference.pixels);
}

void check_sizes(const GoldenFrame& before, const GoldenFrame& after) {
  const cv::Size a = before.left.colour.size(), b = after.left.colour.size();
  if (a != b || before.smaller != after.smaller)
    throw std::runtime_error(fmt::format(
        "{}: the golden picture has {} x {} pixels, one for {} of the camera's, and the new one has {} x {}, "
        "one for {}: the rig is another one",
        file_stem(before.name), a.width, a.height, before.smaller, b.width, b.height, after.smaller));
}

}  // namespace

const char* text_of(PixelPlace place) {
  switch (place) {
    case PixelPlace::kBallEdge:
      return "on balls' edges";
    case PixelPlace::kBall:
      return "inside balls";
    case PixelPlace::kMesh:
      return "on meshes";
    case PixelPlace::kWall:
      return "on walls";
    case PixelPlace::kFloor:
      return "on the floor";
    case PixelPlace::kBackground:
      break;
  }
  return "in the background";
}

long PictureDifference::all_changed() const {
  return std::accumulate(changed.begin(), changed.end(), 0L);
}

bool GoldenDifference::is_none() const {
  const auto is_same = [](const PictureDifference& picture) {
    return picture.has_seen_the_same && picture.all_changed() == 0 && picture.identities == 0;
  };
  return is_same(left) && is_same(right);
}

cv::Mat places_of(const cv::Mat& shown_before, const cv::Mat& shown_after, int first_mesh) {
  cv::Mat places;
  cv::min(places_in(shown_before, first_mesh), places_in(shown_after, first_mesh), places);
  return places;
}

GoldenDifference compare_golden(const GoldenFrame& before, const GoldenFrame& after,
                                const GoldenLimits& limits) {
  check_sizes(before, after);
  GoldenDifference difference{.name = after.name};
  difference.left = compare_pictures(before.left, after.left, limits, before.first_mesh);
  difference.right = compare_pictures(before.right, after.right, limits, before.first_mesh);
  difference.passes = is_within(difference.left, limits) && is_within(difference.right, limits);
  return difference;
}

}  // namespace stereobench::harness
