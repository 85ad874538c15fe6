#include "vision/observe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "vision/camera/rig.h"
#include "vision/colour/blobs.h"
#include "vision/outline/outline_fit.h"
#include "vision/outline/round_patch.h"
#include "vision/pixel_noise.h"
#include "vision/scratch.h"
#include "vision/stereo/range_bearing.h"
#include "vision/stereo/rig_match.h"
#include "vision/stereo/sphere.h"
#include "vision/tuning/detection.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::vision {
namespace {

void check_image(const cv::Mat& image, const Intrinsics& camera, const char* side) {
  if (image.type() != CV_8UC3 || image.empty())
    throw std::invalid_argument(fmt::format("{} image: expected 8-bit BGR (CV_8UC3)", side));
  if (image.cols != camera.width_px || image.rows != camera.height_px)
    throw std::invalid_argument(fmt::format("{} image: {} x {} pixels, the rig's have {} x {}", side,
                                            image.cols, image.rows, camera.width_px, camera.height_px));
}

void check_settings(const ObserverSettings& settings) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(settings.ball_radius_m) || !positive(settings.min_radius_px) ||
      !positive(settings.min_depth_m))
    throw std::invalid_argument("observer settings: expected positive ball radius, outline radius and depth");
  const double tolerance_m = settings.ball_radius_sd_m;
  if (!std::isfinite(tolerance_m) || tolerance_m < 0.0 || tolerance_m > settings.ball_radius_m)
    throw std::invalid_argument("observer settings: expected a tolerance of at most the ball radius");
  if (!positive(settings.rows_within_px))
    throw std::invalid_argument("observer settings: expected positive rows that the rig may be off by");
  if (!std::isfinite(settings.noise_sd_levels) || settings.noise_sd_levels < 0.0)
    throw std::invalid_argument("observer settings: expected an image noise of at least 0 levels");
}

bool same_place(const MeasuredOutline& a, const MeasuredOutline& b) {
  return (a.centre_px - b.centre_px).norm() < kDetection.same_place * std::max(a.radius_px, b.radius_px);
}

using Outlines = ScratchVector<MeasuredOutline>;

// Pieces of one ball, and rims that look like a third colour, all lead to the same outline: the largest patch
// is right.
Outlines without_duplicates(Outlines outlines) {
  std::ranges::sort(outlines, {}, [](const MeasuredOutline& outline) {
    return std::tuple(-outline.seen_px, outline.colour, outline.centre_px.y(), outline.centre_px.x());
  });
  Outlines result;
  for (const MeasuredOutline& outline : outlines) {
    const auto is_same = [&](const MeasuredOutline& other) { return same_place(other, outline); };
    if (std::none_of(result.begin(), result.end(), is_same)) result.push_back(outline);
  }
  return result;
}

// What was found in one camera's picture.
struct Found {
  const cv::Mat& image;
  FitSettings settings;  // with the picture's blur
  Outlines outlines;
};

Outlines fit_outlines(const cv::Mat& image, const ScratchVector<Blob>& blobs, const FitSettings& settings) {
  Outlines outlines;
  for (const Blob& blob : blobs) {
    const auto outline = fit_outline(image, blob, settings);
    if (!outline || outline->hidden_fraction + outline->outside_fraction > 1.0 - kDetection.min_visible)
      continue;
    outlines.push_back(*outline);
  }
  return without_duplicates(std::move(outlines));
}

// The blur of a picture, as all of its balls tell it; 0 of one in focus.
double blur_of(const Outlines& outlines) {
  EdgeProfile edge;
  for (const MeasuredOutline& outline : outlines) edge.add(outline.edge);
  const double blur = edge.blur_px();
  return blur < kDetection.in_focus_px ? 0.0 : blur;
}

// Outlines are measured as if they were in focus, which tells the picture's blur; where there is some, they
// are measured again.
Found find_in(const cv::Mat& image, const Intrinsics& camera, const ObserverSettings& settings) {
  check_settings(settings);
  Found found{image,
              {.camera = camera,
               .noise_sd_levels = settings.noise_sd_levels,
               .min_radius_px = settings.min_radius_px,
               .resampled = settings.resampled},
              {}};
  if (settings.learned != nullptr) {
    const auto patches = find_round_patches(image, *settings.learned, settings.min_radius_px);
    found.outlines.assign(patches.begin(), patches.end());
    found.outlines = without_duplicates(std::move(found.outlines));
    return found;
  }
  const double smallest_disc = 3.14 * settings.min_radius_px * settings.min_radius_px;
  const auto blobs = find_blobs(image, std::lround(kDetection.min_patch * smallest_disc));
  for (int look = 1;; ++look) {
    found.outlines = fit_outlines(image, blobs, found.settings);
    const double blur = blur_of(found.outlines);
    if (look == kDetection.most_looks ||
        std::abs(blur - found.settings.blur_px) <= kDetection.same_blur * blur)
      break;
    found.settings.blur_px = blur;
  }
  return found;
}

// Balls share their light source: each is measured once more by what the others tell of it, seen by either
// camera.
void share_light_source(std::span<Found> sides, const ObserverSettings& settings) {
  LightSourcePool pool(pixel_variance(settings.noise_sd_levels));
  for (const Found& side : sides) {
    for (const MeasuredOutline& outline : side.outlines) pool.add(outline.light);
  }
  for (Found& side : sides) {
    for (MeasuredOutline& outline : side.outlines) {
      if (const auto light_source = pool.without(outline.light))
        outline = refine_outline(side.image, outline, *light_source, side.settings);
    }
  }
}

BallObservation measure(const OutlinePair& pair, const Matched& matched, const BallSize& size) {
  const StereoRig& rig = matched.rig;
  BallFit fit = fit_ball_of_size(rig, pair.left, pair.right, size, pair.ball, pair.disparity_variance_px2);
  fit.covariance_m2(0, 0) += matched.camera_variance_m2;
  BallObservation ball;
  ball.colour = pair.left.colour;
  ball.left_px = pair.left.centre_px;
  ball.right_px = pair.right_px;
  ball.left_radius_px = pair.left.radius_px;
  ball.right_radius_px = pair.right_radius_px;
  ball.ball_in_camera = fit.ball_in_camera;
  ball.range_bearing = range_bearing(ball.ball_in_camera, fit.covariance_m2, robot_from_camera(rig));
  ball.range_bearing.colour_class = ball.colour;
  if (!pair.sizes_agree || !speaks(pair, rig)) {
    ball.truncated =
        std::max(pair.left.outside_fraction, pair.right.outside_fraction) > kOutlineFit.most_hidden;
    ball.occluded = !ball.truncated;
  }
  return ball;
}

bool by_colour_then_column(const BallObservation& a, const BallObservation& b) {
  return a.colour != b.colour ? a.colour < b.colour : a.left_px.x() < b.left_px.x();
}

ObservedPair look_at(const StereoPair& pair, const StereoRig& rig, const ObserverSettings& settings,
                     const RigWatch& watch) {
  if (!is_usable(rig))
    throw std::invalid_argument("rig: expected finite values, positive focal length and baseline");
  check_image(pair.left, rig.intrinsics, "left");
  check_image(pair.right, rig.intrinsics, "right");
  std::array<Found, 2> sides = {find_in(pair.left, rig.intrinsics, settings),
                                find_in(pair.right, rig.intrinsics, settings)};
  share_light_source(sides, settings);
  const BallSize size = {settings.ball_radius_m, settings.ball_radius_sd_m};
  const Matched matched = match_by_watch(sides[0].outlines, sides[1].outlines, rig, settings, watch);
  ObservedPair look{{}, matched.watch};
  look.balls.reserve(matched.pairs.size());
  for (const OutlinePair& outlines : matched.pairs) look.balls.push_back(measure(outlines, matched, size));
  std::sort(look.balls.begin(), look.balls.end(), by_colour_then_column);
  return look;
}

}  // namespace

std::vector<MeasuredOutline> find_outlines(const cv::Mat& image, const Intrinsics& camera,
                                           const ObserverSettings& settings) {
  check_image(image, camera, "the");
  Found found = find_in(image, camera, settings);
  share_light_source({&found, 1}, settings);
  return {found.outlines.begin(), found.outlines.end()};
}

std::vector<BallObservation> observe(const StereoPair& pair, const StereoRig& rig,
                                     const ObserverSettings& settings) {
  return look_at(pair, rig, settings, {}).balls;
}

ObservedPair observe(const StereoPair& pair, const Rectification& rectification,
                     const ObserverSettings& settings, const RigWatch& watch) {
  if (rectification.is_nothing()) return look_at(pair, rectification.rig(), settings, watch);
  ObserverSettings of_rectified = settings;
  of_rectified.resampled = true;
  ObservedPair look = look_at(rectification.apply(pair), rectification.rig(), of_rectified, watch);
  for (BallObservation& seen : look.balls) {
    const bool whole =
        rectification.shows(seen.left_px, seen.left_radius_px + kDetection.rim_px, Side::kLeft) &&
        rectification.shows(seen.right_px, seen.right_radius_px + kDetection.rim_px, Side::kRight);
    seen.truncated = seen.truncated || !whole;
    seen.left_px = rectification.taken_px(seen.left_px, Side::kLeft);
    seen.right_px = rectification.taken_px(seen.right_px, Side::kRight);
  }
  return look;
}

std::vector<BallObservation> observe(const StereoPair& pair, const Rectification& rectification,
                                     const ObserverSettings& settings) {
  return observe(pair, rectification, settings, {}).balls;
}

}  // namespace stereobench::vision
