/// The cameras of any data set as a rig that vision takes.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "harness/io/calibration_file.h"
#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// The rig of two cameras. The same camera twice, side by side, is one model with a right camera that may be
/// turned; two different ones are two models and the rig of their rectified pictures.
///
/// A robot has its origin between the cameras, and x forward. Where the body is one (x forward, y left, z
/// up), the rig has its height and its pitch. Else the cameras look level, at height 0.
/// @param cameras by vision::Side, with the size of their pictures
/// @throws std::runtime_error, one line, for cameras that are not side by side, or cannot be computed with
RigCalibration imported_rig(const std::array<ViewCamera, 2>& cameras);

/// Where the rig's robot is on the body that the data set has poses of.
/// @param left the left camera on the body
Eigen::Isometry3d body_from_robot(const RigCalibration& calibration, const ViewCamera& left);

}  // namespace stereobench::harness
