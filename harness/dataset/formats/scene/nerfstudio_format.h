/// Nerfstudio's layout, `nerfstudio`: pictures and depth with the poses of their cameras.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that vision is told wrong, rows that look one after
/// another.
/// @throws std::runtime_error, one line that names the scenario's key
void check_nerfstudio_format(const DatasetDrive& drive);

/// Writes a scene:
///
///     images/left/000000.png, images/right/   pictures of both cameras, named by their step
///     depth/left/000000.png, depth/right/     planar Z: 16 bits, mm; 0 = nothing, or beyond 65.5 m
///     transforms.json    the camera (one for both), and world_from_camera of each picture, 4 x 4, row by row
///
/// Cameras have OpenGL's axes: x right, y up, z backward. The world is in metres, z up. The first pixel's
/// centre is (0.5, 0.5).
std::unique_ptr<DatasetWriter> nerfstudio_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
