#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "harness/verify/geometry/frame_links.h"

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;
using vision::Side;

/// What a corner is usually found off, px.
constexpr double kUsual_px = 0.25;
constexpr int kHalfPatch = 7;
/// A rectangle around a patch whose correlation is less shows something else.
constexpr double kLeastCorrelation = 0.93;

cv::Mat grey(const cv::Mat& picture) {
  cv::Mat levels = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, levels, cv::COLOR_BGR2GRAY);
  cv::Mat floats;
  levels.convertTo(floats, CV_32F);
  return floats;
}

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

/// Corners of the left picture in the right one, against depth or disparity; without them, their rows.
/// @return where it was found
std::optional<Vector2d> add_stereo(const Neighbourhood& frames, const cv::Mat& left, const cv::Mat& right,
                                   Link link, std::vector<Link>& links) {
  constexpr int kAcross = 3, kDown = 16;
  const cv::Size reach(left.cols / kAcross, left.rows / kDown);
  const cv::Point corner(static_cast<int>(link.from_px.x()), static_cast<int>(link.from_px.y()));
  const auto found = found_in(left, corner, right, reach);
  if (!found) return std::nullopt;
  link.to = link.from;
  link.to_side = Side::kRight;
  link.to_px = *found;
  const bool is_known = link.depth_m[kNow] || link.mate_px[kNow];
  link.kind = is_known ? LinkKind::kStereoPictures : LinkKind::kEpipolar;
  Link at_found;
  set_source({nullptr, frames.now, nullptr}, Side::kLeft, *found, at_found);
  link.found_depth_m = at_found.depth_m[kNow];
  link.found_mate_px = at_found.mate_px[kNow];
  if (!is_known) link.mate_px[kNow] = *found, link.mate_is_measured = true;
  links.push_back(link);
  return found;
}

}  // namespace

void add_picture_links(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                       std::vector<Link>& links) {
  const LoadedFrame& now = *frames.now;
  if (now.picture[0].empty()) return;
  const cv::Mat left = grey(now.picture[0]);
  const bool is_pair = !now.picture[1].empty();
  const bool goes_on =
      frames.after != nullptr && view.frames[now.index].drive_goes_on && !frames.after->picture[0].empty() &&
      frames.after->picture[0].size() == now.picture[0].size() && view.frames[now.index].world_from_body[0] &&
      view.frames[frames.after->index].world_from_body[0];
  const cv::Mat right = is_pair ? grey(now.picture[1]) : cv::Mat();
  const cv::Mat next = goes_on ? grey(frames.after->picture[0]) : cv::Mat();
  constexpr int kAcross = 4, kDown = 6;
  const cv::Size reach(left.cols / kAcross, left.rows / kDown);
  for (const cv::Point& corner : corners_in(left, most)) {
    Link link = {.from = now.index, .to = now.index, .from_px = {corner.x, corner.y}};
    link.tolerance_px = kUsual_px;
    set_source(frames, Side::kLeft, link.from_px, link);
    const bool has_depth = link.depth_m[kNow] || link.mate_px[kNow];
    const auto mate_px = is_pair ? add_stereo(frames, left, right, link, links) : std::nullopt;
    if (!goes_on || !(has_depth || mate_px)) continue;
    const auto found = found_in(left, corner, next, reach);
    if (!found) continue;
    link.kind = LinkKind::kNextPictures;
    link.to = frames.after->index;
    link.to_px = *found;
    if (!has_depth) link.mate_px[kNow] = mate_px, link.mate_is_measured = true;
    links.push_back(link);
  }
}

}  // namespace stereobench::harness
