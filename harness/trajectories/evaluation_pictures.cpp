#include "harness/trajectories/evaluation_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/report/error_picture.h"
#include "harness/report/map_picture.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

/// Two of the axes in space.
struct ViewAxes {
  Eigen::Index right = 0;
  Eigen::Index up = 1;
};

/// The view in which a path extends the most.
ViewAxes widest_view(const std::vector<PoseInSpace>& poses) {
  Eigen::Vector3d low = poses.front().position_m, high = low;
  for (const PoseInSpace& pose : poses) {
    low = low.cwiseMin(pose.position_m);
    high = high.cwiseMax(pose.position_m);
  }
  Eigen::Index across = 0;
  (high - low).minCoeff(&across);
  return {across == 0 ? 1 : 0, across == 2 ? 1 : 2};
}

/// The poses look along the path.
std::vector<slam::Pose> seen(const std::vector<PoseInSpace>& poses, const ViewAxes& view) {
  std::vector<slam::Pose> path;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d& here = poses[i].position_m;
    const Eigen::Vector3d ahead = poses[std::min(i + 1, poses.size() - 1)].position_m - here;
    path.push_back({here(view.right), here(view.up), slam::arc_tangent(ahead(view.up), ahead(view.right))});
  }
  return path;
}

std::string title_of(const Evaluation& evaluation, const std::string& estimate) {
  constexpr std::size_t kMost = 60;
  const std::string name =
      estimate.size() > kMost ? "..." + estimate.substr(estimate.size() - kMost) : estimate;
  return fmt::format("{}, aligned: {}", name, text_of(evaluation.align));
}

}  // namespace

std::string error_picture_of(const Evaluation& evaluation, const std::string& estimate) {
  ErrorCurves curve("estimate");
  curve.add(evaluation.absolute.translation_m);
  return draw_error_picture({.title = title_of(evaluation, estimate),
                             .time_s = times_of(evaluation.pairs),
                             .filters = {curve},
                             .time_axis = evaluation.pairs.stamps_ns.empty() ? "pose" : "time [s]"});
}

std::string path_picture_of(const Evaluation& evaluation, const std::string& estimate) {
  const std::string axes = evaluation.plane ? text_of(*evaluation.plane) + " " : "xyz";
  const TrajectoryPairs& pairs = evaluation.pairs;
  const ViewAxes view = evaluation.plane ? ViewAxes{} : widest_view(pairs.truth);
  return draw_map_picture({.title = title_of(evaluation, estimate),
                           .true_path = seen(pairs.truth, view),
                           .estimates = {{"estimate", seen(pairs.estimate, view), {}}},
                           .to_the_right = axes.substr(static_cast<std::size_t>(view.right), 1),
                           .upwards = axes.substr(static_cast<std::size_t>(view.up), 1)});
}

}  // namespace stereobench::harness
