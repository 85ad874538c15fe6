/// How much of a circle's inside a picture shows, of a thing whose colour is known.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/colour/colour_table.h"
#include "vision/colour/patch_boundary.h"

namespace stereobench::vision {

/// The colour at a place between pixels, BGR; empty outside of the picture.
std::optional<Eigen::Vector3d> colour_at(const cv::Mat& image, const Eigen::Vector2d& at);

/// The class of a colour between levels.
std::uint8_t class_of(const ColourTable& table, const Eigen::Vector3d& bgr);

/// How much of a circle's area within the picture is hidden by something before it.
///
/// Along each ray from the centre, what lies beyond the outermost place of the thing's own colour is in
/// question where that place is deep inside. What hides a thing goes on across its outline; seams, prints,
/// highlights and shade end there. So a ray in question shows the thing after all where the picture, summed
/// along the rays beside it, has a step at the circle that stands out from those at other radii.
/// @param image CV_8UC3, BGR
/// @param colour as the table has it
/// @return in [0, 1]; 1 where nothing is in the picture
double hidden_share(const cv::Mat& image, const Circle& circle, int colour, const ColourTable& table);

/// The share of a circle's area that lies beyond the picture's border.
double outside_share(const cv::Mat& image, const Circle& circle);

}  // namespace stereobench::vision
