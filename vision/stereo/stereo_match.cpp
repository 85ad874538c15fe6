#include "vision/stereo/stereo_match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/camera/rig.h"
#include "vision/tuning/match.h"

namespace stereobench::vision {
namespace {

// How ill two outlines suit each other: 0 is perfect, above 1 they are not the same ball.
struct OutlineMisfit {
  double size = 0.0;  // of both radii, relative to the gate
  double row = 0.0;
  bool sizes_agree = true;
  BallFit ball;
  double disparity_variance_px2 = 0.0;
  MeasuredOutline right;  // repaired
  double total() const { return std::max(size, row); }
};

// The outline that a camera would see of the same ball if it were turned a little: what is farther from the
// principal point is larger, by the square root of the cube of the length of its ray, squared.
MeasuredOutline moved(MeasuredOutline outline, const Eigen::Vector2d& to_px, const Intrinsics& camera) {
  const double stretch2 =
      std::sqrt(pixel_ray(camera, to_px).squaredNorm() / pixel_ray(camera, outline.centre_px).squaredNorm());
  outline.centre_px = to_px;
  outline.radius_px *= stretch2 * std::sqrt(stretch2);
  return outline;
}

std::optional<OutlineMisfit> misfit(const MeasuredOutline& left, MeasuredOutline right, const StereoRig& rig,
                                    const ObserverSettings& settings, const RigBelief& belief) {
  if (left.colour != right.colour) return std::nullopt;
  OutlineMisfit result;
  right = moved(right, belief.rectified_px(rig.intrinsics, right.centre_px), rig.intrinsics);
  const double by_size_px = disparity_by_size_px(rig, left, right, settings.ball_radius_m);
  const Eigen::Vector2d variances = belief.variances_px2(rig.intrinsics, right.centre_px, by_size_px);
  result.disparity_variance_px2 = variances.y();
  const Eigen::Vector2d apart = left.centre_px - right.centre_px;
  if (std::abs(apart.y()) > settings.rows_within_px) return std::nullopt;
  if (variances.y() > 0.0 &&
      std::abs(apart.x() - by_size_px) >
          kMatch.gate_sigmas * std::sqrt(variances.y()) + kMatch.size_gate * by_size_px)
    return std::nullopt;
  const auto ball = fit_ball(rig, left, right, settings.ball_radius_m, result.disparity_variance_px2);
  if (!ball || ball->ball_in_camera.z() < settings.min_depth_m) return std::nullopt;

  result.ball = *ball;
  result.right = right;
  const double row_sd = std::sqrt(left.covariance_px2(1, 1) + right.covariance_px2(1, 1) + variances.x());
  result.row = ball->row_misfit_px / (kMatch.row_gate_px + kMatch.gate_sigmas * row_sd);
  const double radius = std::max(left.radius_px, right.radius_px);
  const double noise =
      kMatch.gate_sigmas * std::sqrt(std::max(left.covariance_px2(2, 2), right.covariance_px2(2, 2)));
  const double made_px = kMatch.tolerance_sds * settings.ball_radius_sd_m / settings.ball_radius_m * radius;
  result.size = ball->radius_misfit_px / (kMatch.size_gate_px + kMatch.size_gate * radius + noise + made_px);
  result.sizes_agree =
      ball->radius_misfit_px <= kMatch.whole_size_gate_px + kMatch.whole_size_gate * radius + noise + made_px;
  return result.total() <= 1.0 ? std::optional(result) : std::nullopt;
}

}  // namespace

ScratchVector<OutlinePair> match_outlines(std::span<const MeasuredOutline> left,
                                          std::span<const MeasuredOutline> right, const StereoRig& rig,
                                          const ObserverSettings& settings, const RigBelief& belief) {
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  ScratchVector<std::size_t> best_of_left(left.size(), kNobody);
  ScratchVector<std::size_t> best_of_right(right.size(), kNobody);
  ScratchVector<OutlineMisfit> misfit_of_left(left.size());
  ScratchVector<OutlineMisfit> misfit_of_right(right.size());
  for (std::size_t l = 0; l < left.size(); ++l) {
    for (std::size_t r = 0; r < right.size(); ++r) {
      const auto found = misfit(left[l], right[r], rig, settings, belief);
      if (!found) continue;
      if (best_of_left[l] == kNobody || found->total() < misfit_of_left[l].total()) {
        best_of_left[l] = r;
        misfit_of_left[l] = *found;
      }
      if (best_of_right[r] == kNobody || found->total() < misfit_of_right[r].total()) {
        best_of_right[r] = l;
        misfit_of_right[r] = *found;
      }
    }
  }
  ScratchVector<OutlinePair> pairs;
  for (std::size_t l = 0; l < left.size(); ++l) {
    const std::size_t r = best_of_left[l];
    if (r == kNobody || best_of_right[r] != l) continue;
    const OutlineMisfit& best = misfit_of_left[l];
    pairs.push_back({left[l], best.right, best.ball, best.sizes_agree, best.disparity_variance_px2,
                     right[r].centre_px, right[r].radius_px});
  }
  return pairs;
}

}  // namespace stereobench::vision
