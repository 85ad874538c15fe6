/// A stereo rig's calibration as `stereobench render` and `calibrate-rig` write it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vision/camera/camera_pair.h"
#include "vision/types.h"

namespace stereobench::harness {

/// What a calibration says of a rig.
struct RigCalibration {
  vision::StereoRig rig;  ///< where `cameras` are given, without faults: what rectified pictures are of
  std::optional<vision::CameraPair> cameras;  ///< where the two differ
};

/// The rig as an OpenCV YAML file: image size, K, P1 and P2 from the left camera's frame (P2[3] = -f B for a
/// rectified rig), baseline, and robot_from_camera.
/// @param cameras of a rig of two different cameras: each one's K, D and rectified_from_eye, beside `rig`,
///        which is then what rectified pictures are of
std::string calibration_yaml(const vision::StereoRig& rig,
                             const std::optional<vision::CameraPair>& cameras = {});

/// Reads calibration.yaml: `image_width`, `image_height`, `K`, `baseline_m`; where they are left out, `D` is
/// zero, and the cameras (`robot_from_left_camera`, `robot_from_right_camera`) look level, at height 0.
/// A rig of two different cameras has `left_eye` and `right_eye`, with their own `K`, `D` and
/// `rectified_from_eye`, as `stereobench calibrate-rig` writes it.
/// @throws std::runtime_error, one line, for what is missing, of another shape, or no rig that can be
///   computed with
RigCalibration read_rig_calibration(const std::filesystem::path& file);

/// The same of a text. @param name what it is called in errors
RigCalibration parse_calibration(const std::string& text, const std::filesystem::path& name);

/// The same of one camera twice.
/// @throws std::runtime_error as above, and where the cameras differ
vision::StereoRig read_calibration(const std::filesystem::path& file);

/// The angles of StereoRig::right_turn_rad, R = Rx Ry Rz.
Eigen::Vector3d turn_angles(const Eigen::Matrix3d& left_from_right);

}  // namespace stereobench::harness
