/// Where what one picture shows is in another one: stereo disparity and optical flow are the same question.
#pragma once

#include "renderer/truth/id_buffer.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::renderer {

/// What becomes of a pixel's point in the other picture.
enum class Occlusion : std::uint8_t {
  kNothing = 0,   ///< the pixel sees no point
  kOutside = 85,  ///< out of the other picture, or behind its camera
  kHidden = 170,  ///< within the other picture, behind something
  kSeen = 255
};

/// For each pixel of a picture, where the point at its centre is in another one.
struct Correspondence {
  cv::Mat
      shift_px;  ///< CV_32FC2, place in the other picture minus place in this one; +inf where there is none
  cv::Mat occlusion;  ///< CV_8UC1, values of Occlusion
};

/// Follows every pixel's point to another look at the same world, by geometry alone.
///
/// Shifts are those of the place on the pixel's own ray that its range says. A point is hidden when the line
/// from the other camera meets something before it, which is decided exactly, with the primitives' own
/// bounds. Nothing is looked for where the other camera's four pixels around the place all see the point's
/// own primitive: what is thinner than a pixel and alone before a primitive is missed, as it is missed by the
/// picture.
Correspondence correspond(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to);

/// Disparity, u in the left picture minus u in the right one.
/// @param side whose picture `to_other_camera` is for
/// @return CV_32FC1, +inf where there is none; positive for points ahead of a rectified rig
cv::Mat disparity_px(const Correspondence& to_other_camera, vision::Side side);

}  // namespace stereobench::renderer
