/// What is drawn over the pictures of a stereo pair: outlines of the truth, and detections.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/result_pages/detection_row.h"
#include "vision/types.h"

namespace stereobench::harness {

/// A ball's outline in a camera's picture.
/// @param centre_px of the outline, where a rig without distortion has it
/// @param radius_px of the circle of the same area
/// @return corners of a closed line, px, in the picture as the lens makes it: an ellipse that points away
/// from the principal point, exact to the second order of the ball's angular radius
std::vector<Eigen::Vector2d> outline_px(const vision::StereoRig& rig, const Eigen::Vector2d& centre_px,
                                        double radius_px);

/// Where a camera's picture shows what a rig without distortion has at a place.
Eigen::Vector2d taken_px(const vision::StereoRig& rig, const Eigen::Vector2d& undistorted_px);

/// What is drawn over the picture of one camera.
/// @param rows of one pair
/// @param rig the true one, which took the picture
FramePanel panel_of(std::span<const DetectionRow> rows, const vision::StereoRig& rig, vision::Side side);

/// What is wrong with a pair, in words: "1 missed, 2 misidentified"; empty where nothing is.
std::string faults_of(std::span<const DetectionRow> rows);

/// The rows of one pair, in their order.
std::vector<DetectionRow> rows_of(std::span<const DetectionRow> rows, std::uint64_t seed, std::size_t frame);

}  // namespace stereobench::harness
