/// What formats share that hold rectified pairs of one instant.
#pragma once

#include <string>

#include "harness/dataset/dataset_pair.h"

namespace stereobench::harness {

/// The 3 x 4 projection matrix [K | t] of a rectified camera, row by row.
/// @param from_left_m how far right of the left camera it is, m
std::string projection_row(const vision::StereoRig& rig, double from_left_m);

/// KITTI's lines P0 to P3, from the first to the last camera that is asked for: 0 and 1 are the left and the
/// right camera in grey, 2 and 3 the same in colour.
std::string kitti_projections(const vision::StereoRig& rig, int first = 0);

/// A picture in grey, by ITU-R BT.601 of its levels.
cv::Mat grey_of(const cv::Mat& picture);

/// A camera's disparity.
/// @return CV_32FC1, px, positive ahead of the rig; +inf where there is none
cv::Mat disparity_of(DatasetPair& pair, vision::Side side);

/// Which pixels' points both cameras see, as Middlebury and ETH3D write it: 255 both, 128 this one alone, 0
/// where there is no disparity.
cv::Mat seen_by_both(DatasetPair& pair, vision::Side side);

/// Middlebury's calib.txt, which ETH3D has too: cam0, cam1, doffs, baseline in mm, size, and the range of the
/// disparities.
/// @param disparity_px of the left camera
std::string middlebury_calibration(const vision::StereoRig& rig, const cv::Mat& disparity_px);

}  // namespace stereobench::harness
