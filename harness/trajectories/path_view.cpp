#include "harness/trajectories/path_view.h"

#include <algorithm>

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
  const Eigen::Vector3d extent = high - low;
  Eigen::Index across = 2;  // also of a straight path, which extends in one axis alone
  for (const Eigen::Index axis : {1, 0})
    if (extent(axis) < extent(across)) across = axis;
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

}  // namespace

PathView path_view(const Evaluation& evaluation) {
  const std::string axes = evaluation.plane ? text_of(*evaluation.plane) + " " : "xyz";
  const TrajectoryPairs& pairs = evaluation.pairs;
  const ViewAxes view = evaluation.plane ? ViewAxes{} : widest_view(pairs.truth);
  return {.truth = seen(pairs.truth, view),
          .estimate = seen(pairs.estimate, view),
          .to_the_right = axes.substr(static_cast<std::size_t>(view.right), 1),
          .upwards = axes.substr(static_cast<std::size_t>(view.up), 1)};
}

}  // namespace stereobench::harness
