/// The layout of the UTIAS Multi-Robot Cooperative Localization and Mapping data set (Leung et al., IJRR
/// 2011), `mrclam`: the log of a drive, without its pictures.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses nothing: the layout says of no sighting how exact it is, nor of which picture.
void check_mrclam_format(const DatasetDrive& drive);

/// Writes, with columns parted by blanks, and numbers that are read back exactly:
///
///     Robot1_Odometry.dat        time, forward velocity, angular velocity, as measured; the last line is the
///                                one before it at the end of the drive
///     Robot1_Measurement.dat     time, barcode, range, bearing, as measured
///     Robot1_Groundtruth.dat     time, x, y, orientation of each step
///     Landmark_Groundtruth.dat   subject, x, y, and their standard deviations, which are 0
///     Barcodes.dat               subject, barcode
///
/// Landmark n is subject n + 6, since 1 to 5 are robots, and its barcode is the same number. A sighting
/// without an identity has the barcode 0, which is nobody's.
std::unique_ptr<DatasetWriter> mrclam_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
