/// Where what one picture shows is in another one: stereo disparity and optical flow are the same question.
#pragma once

#include "renderer/scene_geometry.h"
#include "renderer/sight.h"

namespace stereobench::renderer {

/// What becomes of a pixel's point in the other picture.
enum class Fate : std::uint8_t {
  kNothing = 0,   ///< the pixel sees no point
  kOutside = 85,  ///< out of the other picture, or behind its eye
  kHidden = 170,  ///< within the other picture, behind something
  kSeen = 255
};

/// For each pixel of a picture, where the point at its centre is in another one.
struct Correspondence {
  cv::Mat
      shift_px;  ///< CV_32FC2, place in the other picture minus place in this one; +inf where there is none
  cv::Mat fate;  ///< CV_8UC1, values of Fate
};

/// Follows every pixel's point to another look at the same world, by geometry alone.
///
/// A point is hidden when the line from the other eye meets something before it. What can be in the way is
/// looked for among the facets that the other eye's four pixels around the place see, and then decided
/// exactly, with the facets' own bounds: only what is seen by none of the four (slivers and tips thinner than
/// a pixel) is missed.
Correspondence correspond(const SceneGeometry& scene, const EyeSight& from, const EyeSight& to);

/// Disparity, u in the left picture minus u in the right one.
/// @param eye whose picture `to_other_eye` is for
/// @return CV_32FC1, +inf where there is none; positive for points ahead of a rectified rig
cv::Mat disparity_px(const Correspondence& to_other_eye, vision::Eye eye);

}  // namespace stereobench::renderer
