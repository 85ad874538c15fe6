#include "vision/stereo/rig_match.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/stereo/rig_search.h"
#include "vision/tuning/match.h"
#include "vision/tuning/outline_fit.h"
#include "vision/tuning/rig_watch.h"

namespace stereobench::vision {
namespace {

// Whether each camera sees enough of the outline.
bool shows_enough(const OutlinePair& pair) {
  return std::min(pair.left.inlier_ratio, pair.right.inlier_ratio) > kMatch.least_arc_share;
}

double disparity_sd_px(const OutlinePair& pair, const StereoRig& rig) {
  if (pair.disparity_variance_px2 > 0.0)  // then depth tells of the rig
    return std::sqrt(pair.left.covariance_px2(0, 0) + pair.right.covariance_px2(0, 0));
  const double depth_m = pair.ball.ball_in_camera.z();
  return std::sqrt(pair.ball.covariance_m2(2, 2)) * rig.intrinsics.focal_px * rig.baseline_m /
         (depth_m * depth_m);
}

// Whether the arcs of an outline are of two things, as far as they tell.
bool contradicts_itself(const OutlinePair& pair, const StereoRig& rig) {
  const double reduced_chi_square = std::max(pair.left.reduced_chi_square, pair.right.reduced_chi_square);
  return reduced_chi_square > kMatch.most_reduced_chi_square ||
         (reduced_chi_square > 1.0 && disparity_sd_px(pair, rig) > kMatch.vague_px);
}

// What a ball that is seen whole tells of the rig as it was believed to be.
void tell(const OutlinePair& pair, const StereoRig& rig, const BallSize& size, const RigBelief& belief,
          RigWatch& watch) {
  const MeasuredOutline &left = pair.left, &right = pair.right;
  const bool is_whole = std::max(left.hidden_fraction + left.outside_fraction,
                                 right.hidden_fraction + right.outside_fraction) < kOutlineFit.most_hidden;
  if (!is_whole || !speaks(pair, rig)) return;
  const double by_size_px = disparity_by_size_px(rig, left, right, size.radius_m);
  const double per_radius = by_size_px / (left.radius_px + right.radius_px);
  const double by_tolerance_px = by_size_px * size.radius_sd_m / size.radius_m;
  const Eigen::Matrix3d errors = left.covariance_px2 + right.covariance_px2;
  const BallApart apart{left.centre_px, right.centre_px, errors(1, 1), by_size_px,
                        errors(0, 0) + per_radius * per_radius * errors(2, 2) +
                            kRigMatch.seen_times * by_tolerance_px * by_tolerance_px};
  watch.add(rig.intrinsics, apart, belief);
}

// One pair of pictures, and what was known before.
struct MatchTask {
  std::span<const MeasuredOutline> left, right;
  const StereoRig& rig;
  const ObserverSettings& settings;
};

Matched match_by(const MatchTask& task, const RigBelief& belief, const RigWatch& before) {
  const StereoRig rig = with_baseline(task.rig, belief);
  Matched matched{match_outlines(task.left, task.right, rig, task.settings, belief), rig, before};
  const BallSize size = {task.settings.ball_radius_m, task.settings.ball_radius_sd_m};
  matched.camera_variance_m2 = 0.25 * rig.baseline_m * rig.baseline_m * belief.covariance(3, 3);
  for (const OutlinePair& pair : matched.pairs) tell(pair, task.rig, size, belief, matched.watch);
  return matched;
}

// Whether a search has led anywhere: to more balls, and to two at least unless their rows are apart. A ball
// alone whose size is wrong says nothing of the rig.
bool tells_more(const Matched& found, const Matched& before) {
  const auto rows_apart = [](const OutlinePair& pair) {
    return std::abs(pair.left.centre_px.y() - pair.right_px.y()) > kRigMatch.rows_apart_px;
  };
  const bool is_rig = found.pairs.size() > 1 || std::ranges::any_of(found.pairs, rows_apart);
  return is_rig && found.pairs.size() > before.pairs.size();
}

bool differ(const RigBelief& a, const RigBelief& b) {
  return (a.fault - b.fault).cwiseAbs().maxCoeff() > kRigMatch.same_fault;
}

}  // namespace

bool speaks(const OutlinePair& pair, const StereoRig& rig) {
  return shows_enough(pair) && !contradicts_itself(pair, rig);
}

Matched match_by_watch(std::span<const MeasuredOutline> left, std::span<const MeasuredOutline> right,
                       const StereoRig& rig, const ObserverSettings& settings, const RigWatch& watch) {
  const MatchTask task{left, right, rig, settings};
  RigBelief belief = watch.belief(rig.intrinsics);
  RigWatch before = watch;
  Matched matched = match_by(task, belief, before);
  if (2 * matched.pairs.size() < std::min(left.size(), right.size())) {
    if (const auto found = search_rig(left, right, rig, settings)) {
      Matched anew = match_by(task, *found, {});
      if (tells_more(anew, matched) && anew.watch.balls > watch.balls) {
        matched = std::move(anew);
        belief = *found;
        before = {};
      }
    }
  }
  for (int i = 0; i < kRigMatch.most_matches; ++i) {
    const RigBelief by_now = matched.watch.belief(rig.intrinsics);
    if (!differ(by_now, belief)) break;
    belief = by_now;
    Matched again = match_by(task, belief, before);
    if (again.pairs.size() < matched.pairs.size()) break;
    matched = std::move(again);
  }
  return matched;
}

}  // namespace stereobench::vision
