/// The layout of VSLAM-LAB, `vslamlab`, from which it runs many SLAM programs.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that vision is told wrong, cameras that look at different
/// times or row by row, frames that are late.
/// @throws std::runtime_error, one line that names the scenario's key
void check_vslamlab_format(const DatasetDrive& drive);

/// Writes a sequence, with times in whole nanoseconds from kEpoch_ns; the body is the left camera:
///
///     rgb_0/1500000000100000000.png, rgb_1/   pictures of the left and the right camera, named by their time
///     rgb.csv                                 time and path of both pictures of each pair
///     groundtruth.csv                         each step: time, place, turn (x y z w) of the left camera
///     calibration.yaml                        both cameras: focal lengths, principal point, lens, T_BS
std::unique_ptr<DatasetWriter> vslamlab_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
