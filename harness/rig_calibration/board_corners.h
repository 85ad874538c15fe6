/// A chessboard's corners in a picture.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "harness/rig_calibration/types.h"

namespace stereobench::harness {

/// Finds all inner corners of a board, to a fraction of a pixel.
///
/// Each is where the gradients around it point to (cv::cornerSubPix), within a window that does not reach the
/// next corner: its half width is 0.3 of the shortest side of a square, its own corners then 0.42.
/// @param picture CV_8UC1 or CV_8UC3
/// @return row by row; empty when the board is not seen whole
std::optional<std::vector<Eigen::Vector2d>> find_corners(const cv::Mat& picture, const Board& board);

/// Gives both cameras the same order of corners: a board that looks the same upside down may be read from
/// either end, and the cameras of a rig are not upside down to each other.
void align_orders(BoardView& view);

}  // namespace stereobench::harness
