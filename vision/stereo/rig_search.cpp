#include "vision/stereo/rig_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "vision/camera/rig.h"
#include "vision/scratch.h"
#include "vision/stereo/ball_fit.h"
#include "vision/tuning/rig_watch.h"

namespace stereobench::vision {
namespace {

// Two outlines that may be one ball.
struct CandidatePair {
  std::size_t left = 0, right = 0;
  double rows_apart_px = 0.0;
  Eigen::Vector2d by_turn_px;  // derivative of that by turns about x and z
};

ScratchVector<CandidatePair> candidates_of(std::span<const MeasuredOutline> left,
                                           std::span<const MeasuredOutline> right, const StereoRig& rig,
                                           const ObserverSettings& settings) {
  ScratchVector<CandidatePair> candidates;
  for (std::size_t l = 0; l < left.size(); ++l) {
    for (std::size_t r = 0; r < right.size(); ++r) {
      const MeasuredOutline &a = left[l], &b = right[r];
      const Eigen::Vector2d apart = a.centre_px - b.centre_px;
      if (a.colour != b.colour || std::abs(apart.y()) > settings.rows_within_px) continue;
      if (std::abs(a.radius_px - b.radius_px) >
          kRigSearch.same_size_px + kRigSearch.same_size * std::max(a.radius_px, b.radius_px))
        continue;
      const double by_size_px = disparity_by_size_px(rig, a, b, settings.ball_radius_m);
      const double columns_within_px =
          kRigSearch.turn_about_y_rad * rig.intrinsics.focal_px + kRigSearch.disparity * by_size_px;
      if (std::abs(apart.x() - by_size_px) > columns_within_px) continue;
      const Eigen::Vector2d ray = pixel_ray(rig.intrinsics, b.centre_px).head<2>();
      candidates.push_back(
          {l, r, apart.y(), rig.intrinsics.focal_px * Eigen::Vector2d(-(1.0 + ray.y() * ray.y()), ray.x())});
      if (candidates.size() == kRigSearch.most_candidates) return candidates;
    }
  }
  return candidates;
}

double rest_px(const CandidatePair& candidate, const Eigen::Vector2d& turn) {
  return std::abs(candidate.rows_apart_px - candidate.by_turn_px.dot(turn));
}

// How well a turn explains the candidates: how many, each outline once, less what is left of their rows.
double score_of(const ScratchVector<CandidatePair>& candidates, const Eigen::Vector2d& turn) {
  double score = 0.0;
  for (const CandidatePair& candidate : candidates) {
    const double rest = rest_px(candidate, turn);
    if (rest > kRigSearch.common_trend_px) continue;
    const auto is_rival = [&](const CandidatePair& other) {
      const bool shares = (other.left == candidate.left) != (other.right == candidate.right);
      return shares && rest_px(other, turn) < rest;
    };
    if (std::ranges::any_of(candidates, is_rival)) continue;
    score += 1.0 - 0.1 * rest / kRigSearch.common_trend_px;
  }
  return score;
}

// The least turn that explains two candidates, about, or one.
Eigen::Vector2d turn_by(const CandidatePair& a, const CandidatePair& b) {
  const Eigen::Vector2d usual = usual_fault().covariance.diagonal()(Eigen::Vector2i(0, 2));
  Eigen::Matrix2d information = usual.cwiseInverse().asDiagonal();
  Eigen::Vector2d evidence = Eigen::Vector2d::Zero();
  for (const CandidatePair* candidate : {&a, &b}) {
    information += candidate->by_turn_px * candidate->by_turn_px.transpose();
    evidence += candidate->by_turn_px * candidate->rows_apart_px;
  }
  return information.inverse() * evidence;
}

}  // namespace

std::optional<RigBelief> search_rig(std::span<const MeasuredOutline> left,
                                    std::span<const MeasuredOutline> right, const StereoRig& rig,
                                    const ObserverSettings& settings) {
  const auto candidates = candidates_of(left, right, rig, settings);
  if (candidates.empty()) return std::nullopt;
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = score_of(candidates, best);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (std::size_t j = i; j < candidates.size(); ++j) {
      const Eigen::Vector2d turn = turn_by(candidates[i], candidates[j]);
      const double score = score_of(candidates, turn);
      if (score <= most) continue;
      most = score;
      best = turn;
    }
  }
  RigBelief belief = usual_fault();
  belief.fault[0] = best.x();
  belief.fault[2] = best.y();
  const double rows_sd = 0.5 * kRigSearch.common_trend_px / rig.intrinsics.focal_px;
  belief.covariance(0, 0) = belief.covariance(2, 2) = rows_sd * rows_sd;
  return belief;
}

}  // namespace stereobench::vision
