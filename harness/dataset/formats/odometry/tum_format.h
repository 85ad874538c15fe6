/// The layout of TUM's RGB-D benchmark, `tum`: one camera, its depth, and its trajectory.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that vision is told wrong, cameras that look row by row,
/// frames that are late.
/// @throws std::runtime_error, one line that names the scenario's key
void check_tum_format(const DatasetDrive& drive);

/// Writes the left camera's pictures, named by their time in seconds from kEpoch_ns:
///
///     rgb/1500000000.100000000.png     8-bit colour
///     depth/1500000000.100000000.png   16 bits, planar Z: 5000 levels a metre; 0 = nothing, or beyond 13.1 m
///     rgb.txt, depth.txt               time and name of each picture
///     groundtruth.txt                  time tx ty tz qx qy qz qw of the left camera in the world, each step
///     calibration.yaml                 its lens, which TUM's layout has no file for
std::unique_ptr<DatasetWriter> tum_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
