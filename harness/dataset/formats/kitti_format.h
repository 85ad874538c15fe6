/// The layout of KITTI's stereo benchmark of 2015, `kitti`: a data set that its readers take unchanged.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that are not rectified or believed to be others, cameras
/// that look at different times or row by row, and `--truth`.
/// @throws std::runtime_error, one line that names the scenario's line or the option
void check_kitti_format(const worlds::Scenario& scenario, const TruthRequest& truth);

/// Writes, each stereo pair named by its step:
///
///     image_2/000000_10.png           the left picture, 8-bit colour
///     image_3/000000_10.png           the right picture
///     disp_occ_0/000000_10.png        16 bits, left disparity in 1/256 px of every pixel; 0 = none
///     disp_noc_0/000000_10.png        the same of pixels alone that the right camera sees too
///     calib_cam_to_cam/000000.txt     S_rect, R_rect and P_rect of cameras 02 (left) and 03 (right)
///     calib/000000.txt                P2 and P3, the same projections, as other benchmarks of KITTI have them
///
/// KITTI's projections lead from the frame of its camera 0; here that is the left camera's. There is no
/// second pair (000000_11.png), since steps are frames of a drive: the next step is 000001_10.png.
std::unique_ptr<DatasetWriter> kitti_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
