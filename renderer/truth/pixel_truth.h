/// What a camera's pixels see, beyond identity and depth: derived in double precision from which primitive it
/// is.
#pragma once

#include "renderer/truth/id_buffer.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::renderer {

/// One camera's further truth, all of the rig's width and height.
struct PixelTruth {
  cv::Mat surface;  ///< CV_32SC1, number of the surface (primitives.h), 0 = nothing
  cv::Mat range_m;  ///< CV_32FC1, along the ray from the optical centre, +inf = nothing
  cv::Mat normal;   ///< CV_32FC3, unit normals of the geometry, towards the camera, in its frame; 0 = nothing
};

PixelTruth pixel_truth(const SceneGeometry& scene, const IdBuffer& ids);

}  // namespace stereobench::renderer
