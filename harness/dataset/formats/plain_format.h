/// The program's own data-set format, `plain`: everything there is, a folder for each kind of picture.
/// `stereobench slam` and `stereobench detect` read it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "harness/dataset/formats/dataset_writer.h"
#include "vision/types.h"

namespace stereobench::harness {

/// Files of a drive that are read back.
inline constexpr const char* kBallsFile = "balls.csv";
inline constexpr const char* kCalibrationFile = "calibration.yaml";
inline constexpr const char* kTrueCalibrationFile = "true_calibration.yaml";

/// The folder of one camera's pictures of a kind.
/// @param kind "" for what the camera stored, "id", "depth", a kind of truth ("flow") or an occlusion mask
/// @return "left", "left_id", "right_flow", ...
std::string picture_folder(vision::Side side, std::string_view kind = "");

/// Refuses truth that the scenario does not have. @throws std::runtime_error as require_truth
void check_plain_format(const DatasetDrive& drive);

/// Writes, each file of a stereo pair named by its step:
///
///     left/000000.png         what the sensor stored, 8-bit BGR
///     left_id/000000.png      8 bits: 0 = no ball, k = ball_id k - 1 of balls.csv
///     left_depth/000000.pfm   planar Z in metres, +inf = nothing
///
/// for the left camera and likewise for the right one, and of the truth that was asked for:
///
///     left_balls/000000.jsonl      a line for each ball whose outline meets the picture (ball_lines.h)
///     left_surface/000000.png      16 bits: surface_id of surfaces.csv, 0 = nothing
///     left_range/000000.pfm        metres along the ray, +inf = nothing
///     left_normal/000000.pfm       red, green, blue: x, y, z in the camera frame, 0 = nothing
///     left_disparity/000000.pfm    px, u in the left picture minus u in the right one, +inf = nothing
///     left_match/000000.pfm        red, green: px to the other camera's picture; blue: 1 = seen there
///     left_flow/000000.pfm         the same to the next step's picture of this camera; the last has none
///     left_disparity_fate/000000.png, left_match_fate/, left_flow_fate/
///                                  8 bits: values of renderer::Occlusion
///
/// With --truth-format kitti, disparity, match and flow are PNGs (truth_pictures.h). Of the drive there are:
///
///     calibration.yaml             the rig as vision takes it to be
///     true_calibration.yaml        the rig as it is
///     balls.csv, surfaces.csv      what identities and surfaces are; surfaces.csv where they are wanted
///     odometry.csv, observations.csv, landmarks.csv, groundtruth.csv, instants.csv
///                                  the log that `stereobench slam` reads
///     frames.csv, draws.jsonl      when the cameras looked; what the seed drew, where it draws something
///
/// @throws std::runtime_error when there are more surfaces than 16 bits can number
std::unique_ptr<DatasetWriter> plain_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
