#include "harness/verify/geometry/corner_match.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;

constexpr int kHalfPatch = 7;
/// A rectangle around a patch whose correlation is less shows something else.
constexpr double kLeastCorrelation = 0.93;

cv::Rect patch_around(const cv::Point& pixel, int half = kHalfPatch) {
  return {pixel.x - half, pixel.y - half, 2 * half + 1, 2 * half + 1};
}

bool is_within(const cv::Rect& inner, const cv::Mat& picture) {
  return (inner & cv::Rect({}, picture.size())) == inner;
}

/// The whole pixel around which another picture looks most like a patch.
/// @param reach px, across and down
std::optional<cv::Point> coarse_match(const cv::Mat& from, const cv::Point& corner, const cv::Mat& to,
                                      const cv::Size& reach) {
  const cv::Rect patch = patch_around(corner);
  cv::Rect window(patch.x - reach.width, patch.y - reach.height, patch.width + 2 * reach.width,
                  patch.height + 2 * reach.height);
  window &= cv::Rect({}, to.size());
  if (window.width < patch.width || window.height < patch.height) return std::nullopt;
  cv::Mat score;
  cv::matchTemplate(to(window), from(patch), score, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point place;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
  if (!(best >= kLeastCorrelation)) return std::nullopt;
  // A second place that looks nearly the same would be as good an answer.
  constexpr double kAsGood = 0.97;
  cv::rectangle(score, patch_around(place, 3), cv::Scalar(-1.0), cv::FILLED);
  double second = 0.0;
  cv::minMaxLoc(score, nullptr, &second);
  if (second > kAsGood * best) return std::nullopt;
  return place + window.tl() + cv::Point(kHalfPatch, kHalfPatch);
}

/// The place to a fraction of a pixel, by Lucas and Kanade.
std::optional<Vector2d> refined(const cv::Mat& from, const cv::Point& corner, const cv::Mat& to,
                                Vector2d place) {
  constexpr int kSteps = 15;
  constexpr double kStill_px = 0.003, kFarthest_px = 2.0;
  const Vector2d start = place;
  const cv::Rect wide = patch_around(corner, kHalfPatch + 1);
  if (!is_within(wide, from)) return std::nullopt;
  cv::Mat dx, dy, patch;
  cv::Sobel(from(wide), dx, CV_32F, 1, 0, 1, 0.5);
  cv::Sobel(from(wide), dy, CV_32F, 0, 1, 1, 0.5);
  const cv::Rect inside(1, 1, 2 * kHalfPatch + 1, 2 * kHalfPatch + 1);
  dx = dx(inside).clone(), dy = dy(inside).clone();
  const cv::Mat wanted = from(patch_around(corner));
  Eigen::Matrix2d normal;
  normal << dx.dot(dx), dx.dot(dy), dx.dot(dy), dy.dot(dy);
  if (!(normal.determinant() > 0.0)) return std::nullopt;
  for (int step = 0; step < kSteps; ++step) {
    cv::getRectSubPix(to, wanted.size(), cv::Point2d(place.x(), place.y()), patch);
    const cv::Mat off = wanted - cv::mean(wanted)[0] - (patch - cv::mean(patch)[0]);
    const Vector2d change = normal.inverse() * Vector2d(dx.dot(off), dy.dot(off));
    place += change;
    if ((place - start).norm() > kFarthest_px) return std::nullopt;
    if (change.norm() < kStill_px) return place;
  }
  return std::nullopt;
}

}  // namespace

cv::Mat grey_levels(const cv::Mat& picture) {
  cv::Mat levels = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, levels, cv::COLOR_BGR2GRAY);
  cv::Mat floats;
  levels.convertTo(floats, CV_32F);
  return floats;
}

std::optional<Vector2d> found_in(const cv::Mat& from, const cv::Point& corner, const cv::Mat& to,
                                 const cv::Size& reach) {
  const auto coarse = coarse_match(from, corner, to, reach);
  if (!coarse || !is_within(patch_around(*coarse), to)) return std::nullopt;
  // What is found in the other picture must be found here: of two things that look alike, one is not.
  const auto back = coarse_match(to, *coarse, from, reach);
  if (!back || std::max(std::abs(back->x - corner.x), std::abs(back->y - corner.y)) > 1) return std::nullopt;
  return refined(from, corner, to, Vector2d(coarse->x, coarse->y));
}

std::vector<cv::Point> corners_in(const cv::Mat& picture, std::size_t most) {
  constexpr double kQuality = 0.02, kApart_px = 8.0;
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(picture, found, static_cast<int>(most), kQuality, kApart_px);
  std::vector<cv::Point> corners;
  for (const cv::Point2f& corner : found) {
    const cv::Point pixel(cvRound(corner.x), cvRound(corner.y));
    if (is_within(patch_around(pixel, kHalfPatch + 1), picture)) corners.push_back(pixel);
  }
  return corners;
}

}  // namespace stereobench::harness
