/// Corners of a picture, found again in another one.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace stereobench::harness {

/// A picture's grey levels. @param picture CV_8UC1 or CV_8UC3. @return CV_32FC1
cv::Mat grey_levels(const cv::Mat& picture);

/// Corners whose surroundings are in the picture, the clearest first. @param picture CV_32FC1
std::vector<cv::Point> corners_in(const cv::Mat& picture, std::size_t most);

/// The place around which another picture looks as it does around a corner, to a fraction of a pixel.
/// @param from, to CV_32FC1. @param reach how far it is searched, px across and down
/// @return empty where nothing looks like it, two things do, or it leads back to another place
std::optional<Eigen::Vector2d> found_in(const cv::Mat& from, const cv::Point& corner, const cv::Mat& to,
                                        const cv::Size& reach);

}  // namespace stereobench::harness
