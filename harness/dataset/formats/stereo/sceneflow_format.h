/// The layout of Freiburg's Scene Flow data sets, `sceneflow`, as its part Monkaa has it.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that are not rectified or believed to be others, cameras
/// that look at different times or row by row, frames that are late or lost.
/// @throws std::runtime_error, one line that names the scenario's key
void check_sceneflow_format(const DatasetDrive& drive);

/// Writes a scene, named by the scenario and the seed, each picture by its step:
///
///     frames_cleanpass/room_0/left/0000.png, right/          the pictures
///     disparity/room_0/left/0000.pfm, right/                 px; 0 = nothing
///     optical_flow/room_0/into_future/left/OpticalFlowIntoFuture_0000_L.pfm, right/..._R.pfm
///                                                            red, green: px to the next step; blue: 0
///     camera_data/room_0/camera_data.txt                     of each frame, world_from_camera of the left
///                                                            and the right camera: 4 x 4, z backward, y up
std::unique_ptr<DatasetWriter> sceneflow_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
