/// Round things of real colours: shaded, with highlights, and not quite round.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/colour/colour_table.h"
#include "vision/outline/outline_fit.h"

namespace stereobench::vision {

/// Finds round patches of learned colours and measures each as a circle.
///
/// Where the outline_fit knows what colours a ball's shades can have, here only the patch's own pixels say.
/// Rays from its centre are split into the two colours that they begin and end with; how much of a ray the
/// first one covers says where the edge is, to a fraction of a pixel. The circle is a robust fit to the edges
/// (Tukey's weights); its covariance counts how far real things are from round.
/// @param image CV_8UC3, BGR, as the table's colours were learned
/// @return those of which a fifth of the outline or more is seen; the largest patches first
std::vector<MeasuredOutline> find_round_patches(const cv::Mat& image, const ColourTable& table,
                                                double min_radius_px);

}  // namespace stereobench::vision
