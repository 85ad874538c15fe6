/// The layouts of KITTI's stereo and scene-flow benchmarks: `kitti-stereo`, `kitti-stereo-2012` and
/// `kitti-scene-flow`.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuse what the layouts have no place for: rigs that are not rectified or believed to be others, and
/// cameras that look at different times or row by row; those of 2015, frames that are late or lost.
/// @throws std::runtime_error, one line that names the scenario's key
void check_kitti_stereo_format(const DatasetDrive& drive);
void check_kitti_stereo_2012_format(const DatasetDrive& drive);
void check_kitti_scene_flow_format(const DatasetDrive& drive);

/// Writes the layout of 2015, each stereo pair named by its step:
///
///     image_2/000000_10.png           the left picture, 8-bit colour
///     image_3/000000_10.png           the right picture
///     disp_occ_0/000000_10.png        16 bits, left disparity in 1/256 px of every pixel; 0 = none
///     disp_noc_0/000000_10.png        the same of pixels alone that the right camera sees too
///     disp_occ_1/000000_10.png        the disparity that the pixel's point has at the next step
///     disp_noc_1/000000_10.png        the same of pixels alone that the left camera then sees
///     calib_cam_to_cam/000000.txt     size, lens, place and projection of the cameras 00 to 03
///     calib/000000.txt                P2 and P3, the same projections, as other benchmarks of KITTI have them
///
/// KITTI's projections lead from the frame of its camera 0; here that is the left camera's.
std::unique_ptr<DatasetWriter> kitti_stereo_writer(const DatasetDrive& drive);

/// Writes the layout of 2012: colored_0/ and colored_1/ for image_2/ and image_3/, image_0/ and image_1/ with
/// the same in grey, disp_occ/ and disp_noc/, and calib/ with P0 to P3. It has no second pairs and no flow.
std::unique_ptr<DatasetWriter> kitti_stereo_2012_writer(const DatasetDrive& drive);

/// Writes the layout of 2015 with the second pictures, `image_2/000000_11.png` and `image_3/000000_11.png`,
/// which are those of the next step, and the flow to them:
///
///     flow_occ/000000_10.png          16 bits: red and green (64 times the px) + 2^15, blue 1 = valid
///     flow_noc/000000_10.png          the same of pixels alone that the next picture shows too
///
/// A step without a next one that has pictures is only a second pair, of the step before.
std::unique_ptr<DatasetWriter> kitti_scene_flow_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
