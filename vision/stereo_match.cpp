#include "vision/stereo_match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/rig.h"
#include "vision/sphere.h"

namespace stereobench::vision {
namespace {

constexpr double kGateSigmas = 4.0;
constexpr double kRowGate_px = 0.35;  // beyond noise: the rig's and the fit's own errors
constexpr double kSizeGate_px = 0.45;
constexpr double kSizeGate = 0.08;  // relative; beyond it two outlines are not one ball
constexpr double kWholeSizeGate_px = 0.2;
constexpr double kWholeSizeGate = 0.025;  // relative; beyond it the ball is not whole

// How ill two outlines suit each other: 0 is perfect, above 1 they are not the same ball.
struct Misfit {
  double size = 0.0;  // of both radii, relative to the gate
  double row = 0.0;
  bool sizes_agree = true;
  double total() const { return std::max(size, row); }
};

double radius_error(const Intrinsics& camera, const Eigen::Vector3d& ball_in_eye, double ball_radius_m,
                    const MeasuredOutline& outline) {
  const auto expected = sphere_outline(camera, ball_in_eye, ball_radius_m);
  return expected ? std::abs(outline.radius_px - expected->radius_px()) : outline.radius_px;
}

std::optional<Misfit> misfit(const MeasuredOutline& left, const MeasuredOutline& right, const StereoRig& rig,
                             const ObserverSettings& settings) {
  if (left.colour != right.colour) return std::nullopt;
  const auto ball = triangulate_ball(rig, left.centre_px, right.centre_px, settings.ball_radius_m);
  if (!ball || ball->z() < settings.min_depth_m) return std::nullopt;

  Misfit result;
  const double row_sd = std::sqrt(left.covariance_px2(1, 1) + right.covariance_px2(1, 1));
  result.row = std::abs(left.centre_px.y() - right.centre_px.y()) / (kRowGate_px + kGateSigmas * row_sd);
  const double left_error = radius_error(rig.camera, *ball, settings.ball_radius_m, left);
  const double right_error =
      radius_error(rig.camera, point_in_eye(rig, *ball, Eye::kRight), settings.ball_radius_m, right);
  const double error = std::max(left_error, right_error);
  const double radius = std::max(left.radius_px, right.radius_px);
  const double noise = kGateSigmas * std::max(left.radius_sd_px, right.radius_sd_px);
  result.size = error / (kSizeGate_px + kSizeGate * radius + noise);
  result.sizes_agree = error <= kWholeSizeGate_px + kWholeSizeGate * radius + noise;
  return result.total() <= 1.0 ? std::optional(result) : std::nullopt;
}

}  // namespace

std::vector<OutlinePair> match_outlines(const std::vector<MeasuredOutline>& left,
                                        const std::vector<MeasuredOutline>& right, const StereoRig& rig,
                                        const ObserverSettings& settings) {
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> best_of_left(left.size(), kNobody);
  std::vector<std::size_t> best_of_right(right.size(), kNobody);
  std::vector<Misfit> misfit_of_left(left.size());
  std::vector<Misfit> misfit_of_right(right.size());
  for (std::size_t l = 0; l < left.size(); ++l) {
    for (std::size_t r = 0; r < right.size(); ++r) {
      const auto found = misfit(left[l], right[r], rig, settings);
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
  std::vector<OutlinePair> pairs;
  for (std::size_t l = 0; l < left.size(); ++l) {
    const std::size_t r = best_of_left[l];
    if (r == kNobody || best_of_right[r] != l) continue;
    pairs.push_back({left[l], right[r], misfit_of_left[l].sizes_agree});
  }
  return pairs;
}

}  // namespace stereobench::vision
