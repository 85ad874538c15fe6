/// Bringing an estimate into the frame of the truth.
#pragma once

#include <string_view>

#include "harness/trajectories/types.h"

namespace stereobench::harness {

enum class AlignmentKind {
  kNone,    ///< as it is
  kOrigin,  ///< the first pose is the truth's
  kSe2,     ///< both in a plane; turned and shifted
  kSim2,    ///< and scaled
  kSe3,     ///< turned and shifted
  kSim3,    ///< and scaled
};

/// The plane of kSe2 and kSim2, by its two axes.
enum class Plane { kXy, kXz, kYz };

/// truth = scale * rotation * estimate + shift
struct Alignment {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  double scale = 1.0;
};

/// Whether a kind is of two dimensions.
bool is_in_plane(AlignmentKind kind);

/// Projects both paths to a plane, whose axes become x and y. The coordinate across it is 0, and of a
/// rotation that about its normal is kept which is nearest.
TrajectoryPairs in_plane(TrajectoryPairs pairs, Plane plane);

/// The alignment that fits the positions best in least squares (Umeyama, PAMI 13(4) 1991); that of the first
/// poses for kOrigin.
///
/// @param pairs at least one; as in_plane() gives them
/// @throws std::runtime_error, one line, where the positions do not say how to turn or scale
Alignment align(const TrajectoryPairs& pairs, AlignmentKind kind);

/// The estimate in the truth's frame.
std::vector<PoseInSpace> aligned(const std::vector<PoseInSpace>& estimate, const Alignment& alignment);

}  // namespace stereobench::harness
