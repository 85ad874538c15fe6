/// What to make of a sighting that lies beyond the gate of its landmark.
#pragma once

#include "slam/association/landmark.h"
#include "slam/association/sighting.h"

namespace stereobench::slam {

/// Decides who is wrong: the sighting, the landmark or the pose.
///
/// A landmark that is contradicted several times in a row is no victim of outliers. When an older landmark
/// has corroborated the pose in this frame, or the landmark itself was seen rarely, it is found anew;
/// otherwise the pose has drifted.
///
/// @param landmark how it fared before this sighting
/// @param certain whether no other landmark can have been seen, so that no patience is needed
/// @param corroborated whether some landmark has corrected the pose in this frame
/// @return kUse when the pose has drifted, kMove when the landmark is wrong, kRefuse for an outlier
Outcome judge_contradiction(const TrackRecord& landmark, bool certain, bool corroborated);

/// The covariance of a drift that explains why a landmark was seen this far from where it should have been.
Eigen::Matrix3d drift_covariance(const Pose& pose, const Eigen::Vector2d& landmark,
                                 const Observation& observation);

}  // namespace stereobench::slam
