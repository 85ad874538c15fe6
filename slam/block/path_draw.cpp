#include "slam/block/path_draw.h"

#include <optional>

#include "slam/ekf/frame_mode.h"
#include "slam/ekf/joint_belief.h"
#include "slam/math/gaussian.h"
#include "slam/models/chord.h"

namespace stereobench::slam {
namespace {

/// What the filter believes of the pose at a frame.
struct FilteredPose {
  Eigen::Vector2d lever;  ///< by which the heading before the motion swings this pose
  PoseBelief predicted;
  PoseBelief corrected;
};

/// The pose and the landmarks that a frame shows, whose places are certain.
JointBelief with_places(const PoseBelief& from, const BlockFrame& frame,
                        std::span<const Eigen::Vector2d> places) {
  JointBelief belief{.pose = from.mean};
  belief.covariance.move_pose(Eigen::Vector2d::Zero(), from.covariance);
  for (const UsedSighting& sighting : frame.used) {
    long nothing_to_repair = 0;
    belief.covariance.place(static_cast<int>(belief.landmarks.size()), Eigen::Matrix<double, 2, 3>::Zero(),
                            Eigen::Matrix2d::Zero(), nothing_to_repair);
    belief.landmarks.push_back(places[static_cast<std::size_t>(sighting.landmark)]);
  }
  return belief;
}

FilteredPose filter(const PoseBelief& from, const BlockFrame& frame, std::span<const Eigen::Vector2d> places,
                    long& repairs) {
  const ChordBelief motion = chord_with_slack(frame.motion);
  std::vector<SeenLandmark> seen;
  for (const UsedSighting& sighting : frame.used)
    seen.push_back({static_cast<int>(seen.size()), sighting.observation});
  const JointBelief before = with_places(from, frame, places);
  const FrameMode mode =
      frame_mode(before, motion, seen).value_or(FrameMode{from.mean, motion.mean, before.landmarks, {}});
  const JointBelief at{end_of(mode.from, mode.chord), before.landmarks, {}};
  JointBelief belief = predict_at(mode, before, motion);
  FilteredPose filtered{
      heading_lever(mode.from, {at.pose.x_m, at.pose.y_m}), {belief.pose, belief.covariance.pose()}, {}};
  for (const auto& [landmark, observation] : seen) {
    const long repairs_before = repairs;
    const JointInnovation innovated = innovation(belief, at, landmark, observation, repairs);
    if (repairs == repairs_before) correct(belief, landmark, innovated, repairs);  // else all is certain
  }
  filtered.corrected = {belief.pose, belief.covariance.pose()};
  return filtered;
}

/// @param variances of which the belief's covariance is what is left
Pose draw(const PoseBelief& belief, const Eigen::Vector3d& variances, RandomStream& random, long& repairs) {
  const PivotedRoot<3> root = pivoted_root<3>(belief.covariance, variances, repairs);
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = random.normal();
  return boxplus(belief.mean, root.lower * normals);
}

/// What is believed of a pose once the next one is known.
PoseBelief given_next(const PoseBelief& belief, const FilteredPose& after, const Pose& next) {
  constexpr double kVanishing = 1e-10;
  PoseBelief given = belief;
  Eigen::Matrix3d shared;  // with the next pose: P F'
  for (int j = 0; j < 2; ++j)
    shared.col(j) = belief.covariance.col(j) + after.lever[j] * belief.covariance.col(2);
  shared.col(2) = belief.covariance.col(2);
  Eigen::Matrix3d ahead = after.predicted.covariance;
  Eigen::Vector3d unexplained = boxminus(next, after.predicted.mean);
  Eigen::Vector3d learnt = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double variance = ahead(i, i);
    if (!(variance > kVanishing * after.predicted.covariance(i, i))) continue;
    const Eigen::Vector3d with_seen = shared.col(i);
    const Eigen::Vector3d gain = with_seen / variance;
    const double seen = unexplained[i];
    learnt += gain * seen;
    for (int j = 0; j < 3; ++j) given.covariance.col(j) -= gain * with_seen[j];
    for (int j = i + 1; j < 3; ++j) {
      const double share = ahead(i, j) / variance;
      unexplained[j] -= share * seen;
      shared.col(j) -= share * with_seen;
      for (int k = i + 1; k < 3; ++k) ahead(j, k) -= share * ahead(i, k);
    }
  }
  given.mean = boxplus(belief.mean, learnt);
  return given;
}

}  // namespace

std::vector<Pose> draw_path(const Pose& start, std::span<const BlockFrame> frames,
                            std::span<const Eigen::Vector2d> places, RandomStream& random, long& repairs) {
  std::vector<FilteredPose> filtered;
  for (const BlockFrame& frame : frames)
    filtered.push_back(
        filter(filtered.empty() ? PoseBelief{start} : filtered.back().corrected, frame, places, repairs));
  std::vector<Pose> path(frames.size());
  for (std::size_t k = frames.size(); k-- > 0;) {
    const PoseBelief& here = filtered[k].corrected;
    const bool last = k + 1 == frames.size();
    path[k] = draw(last ? here : given_next(here, filtered[k + 1], path[k + 1]), here.covariance.diagonal(),
                   random, repairs);
  }
  return path;
}

}  // namespace stereobench::slam
