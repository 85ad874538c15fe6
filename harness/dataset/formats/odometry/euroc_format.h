/// The layout of EuRoC's MAV data sets, `euroc`, also called ASL.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: lenses with k3, rigs that vision is told wrong, cameras that
/// look at different times or row by row, frames that are late.
/// @throws std::runtime_error, one line that names the scenario's key
void check_euroc_format(const DatasetDrive& drive);

/// Writes, with times in whole nanoseconds from kEpoch_ns; the body is the robot:
///
///     mav0/cam0/data/1500000000100000000.png   the left camera's picture, colour, named by its time
///     mav0/cam0/data.csv, sensor.yaml          time and name of each picture; lens and place on the robot
///     mav0/cam1/...                            the same of the right camera
///     mav0/state_groundtruth_estimate0/        of each step: data.csv, with place, turn, speed and biases
///                                              (there is no IMU: they are 0), and sensor.yaml
///     mav0/body.yaml
///
/// Speeds are means since the step before; the first step has those of the second one.
std::unique_ptr<DatasetWriter> euroc_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
