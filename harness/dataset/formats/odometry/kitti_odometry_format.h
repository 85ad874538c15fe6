/// The layout of KITTI's odometry benchmark, `kitti-odometry`.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that are not rectified or believed to be others, cameras
/// that look at different times or row by row, frames that are late.
/// @throws std::runtime_error, one line that names the scenario's key
void check_kitti_odometry_format(const DatasetDrive& drive);

/// Writes a sequence that has the number of the seed. Frames are counted without gaps, from 0, also where
/// some steps have no pictures: times.txt says when they were taken.
///
///     sequences/00/image_0/000000.png, image_1/    grey pictures of the left and the right camera
///     sequences/00/image_2/000000.png, image_3/    the same in colour
///     sequences/00/calib.txt                       P0 to P3, 3 x 4; P1[3] = P3[3] = -f B; Tr of no scanner
///     sequences/00/times.txt                       seconds since the first frame
///     sequences/00/velodyne/none.txt               readers ask for the folder; there is no laser scanner
///     poses/00.txt                                 3 x 4 of the left camera in its first frame's axes
std::unique_ptr<DatasetWriter> kitti_odometry_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
