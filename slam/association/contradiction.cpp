#include "slam/association/contradiction.h"

#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

constexpr int kPatience = 5;   ///< contradictions in a row before they are taken seriously
constexpr int kConfirmed = 3;  ///< agreements that make a landmark worth believing against the odometry

}  // namespace

Outcome judge_contradiction(const TrackRecord& landmark, bool certain, bool corroborated) {
  const bool persistent = landmark.refusals + 1 >= kPatience;
  const bool pose_is_wrong = !corroborated && (certain || landmark.uses >= kConfirmed);
  if (pose_is_wrong && (certain || persistent)) return Outcome::kUse;
  return persistent ? Outcome::kMove : Outcome::kRefuse;
}

Eigen::Matrix3d drift_covariance(const Pose& pose, const Eigen::Vector2d& landmark,
                                 const Observation& observation) {
  constexpr double kHeadingPerMetre_rad = 0.1;
  const double off_m2 = (locate(pose, observation.range_bearing) - landmark).squaredNorm();
  return Eigen::Vector3d(off_m2, off_m2, kHeadingPerMetre_rad * kHeadingPerMetre_rad * off_m2).asDiagonal();
}

}  // namespace stereobench::slam
