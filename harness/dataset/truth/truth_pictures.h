/// Truth as pictures that other programs read. Channels are in OpenCV's order (blue first), so that files and
/// readers that speak of red, green and blue find x, y and z.
#pragma once

#include "renderer/truth/correspondence.h"

namespace stereobench::harness {

/// KITTI's disparity: 256 times as large, 0 = none. Beyond its range (below 1/512 px, above 255.99 px): none.
/// @param disparity_px CV_32FC1, +inf = none
/// @return CV_16UC1
cv::Mat kitti_disparity(const cv::Mat& disparity_px);

/// KITTI's flow: red and green are 64 times the shift plus 2^15, blue is 1 where there is one within its
/// range of 512 px either way, also of what is hidden.
/// @return CV_16UC3
cv::Mat kitti_shift(const renderer::Correspondence& found);

/// Red and green are the shift in px, +inf = none; blue is 1 where the point is seen there, else 0.
/// @return CV_32FC3
cv::Mat exact_shift(const renderer::Correspondence& found);

/// Depth as levels. Nothing, and what is beyond their range, is 0.
/// @param depth_m CV_32FC1, +inf = nothing
/// @return CV_16UC1, rounded
cv::Mat depth_levels(const cv::Mat& depth_m, double levels_per_metre);

/// Normals with x in red, y in green, z in blue. @param normal CV_32FC3: x, y, z
cv::Mat normal_picture(const cv::Mat& normal);

}  // namespace stereobench::harness
