/// What cameras behind lenses that distort look at.
#pragma once

#include "renderer/truth/id_buffer.h"
#include "renderer/truth/scene_geometry.h"

namespace stereobench::renderer {

/// Finds the primitive that each distorted ray meets: rasterisers draw straight lines, so what can be met
/// is looked for among the primitives of four pixels of an undistorted picture, and then decided exactly.
/// @param undistorted what a camera of the rig's pinhole (pinhole_rig_of in lens.h) sees
/// @param rig as it is, with its lens
/// @throws std::invalid_argument when the lens folds its picture
IdBuffer distorted_ids(const SceneGeometry& scene, const IdBuffer& undistorted, const vision::StereoRig& rig);

}  // namespace stereobench::renderer
