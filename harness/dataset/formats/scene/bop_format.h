/// BOP's layout of 6-D object poses, `bop`.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: lenses, rigs that vision is told wrong, rows that look one after
/// another.
/// @throws std::runtime_error, one line that names the scenario's key
void check_bop_format(const DatasetDrive& drive);

/// Writes BOP's classic layout, lengths in mm. The cameras are two splits of the same scene, as T-LESS and HB
/// have one for each sensor; cam_R_w2c and cam_t_w2c say where each camera is. The scene's number is the
/// seed.
///
///     test_left/000000/rgb/000000.png         the picture, named by its step
///     test_left/000000/depth/000000.png       planar Z: 16-bit level / 5 mm, 0 = nothing, or beyond 13.1 m
///     test_left/000000/mask/000000_000000.png, mask_visib/
///                                             255: within the ball's outline; shows the ball. STEP_BALL, the
///                                             place in the step's list of scene_gt.json
///     test_left/000000/scene_camera.json, scene_gt.json, scene_gt_info.json
///     test_right/...                          the same of the right camera
///     camera.json                             the cameras, and the levels of depth
///     models/obj_000001.ply, models_info.json
///
/// An object is a colour and a radius: a sphere around the model's origin, whose axes are those of the world.
/// Each step lists the balls whose outlines meet the picture, hidden ones with visib_fract 0. BOP's
/// symmetries are turns about one axis: a sphere has three of them.
std::unique_ptr<DatasetWriter> bop_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
