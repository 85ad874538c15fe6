/// Pictures of fewer pixels.
#pragma once

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// The mean of the stored values of each N x N pixels, channel by channel; halves are rounded to the even
/// value, so that the mean of a whole picture stays.
/// @param picture CV_8UC1, CV_8UC3, CV_16UC1 or CV_16UC3, whose sides are multiples of `divide`
cv::Mat area_mean(const cv::Mat& picture, int divide);

}  // namespace stereobench::harness
