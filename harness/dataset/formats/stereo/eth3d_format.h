/// The layout of ETH3D's two-view benchmark, `eth3d`: pictures and truth apart, a folder a pair in each.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for, as check_middlebury_format.
/// @throws std::runtime_error, one line that names the scenario's key
void check_eth3d_format(const DatasetDrive& drive);

/// Writes two folders for each stereo pair, named by its step:
///
///     two_view_training/000000/im0.png, im1.png            the left and the right picture
///     two_view_training/000000/calib.txt                   as Middlebury's
///     two_view_training_gt/000000/disp0GT.pfm              the left disparity, px; +inf = nothing
///     two_view_training_gt/000000/mask0nocc.png            255 = both cameras see it, 128 = the left one
///                                                          alone, 0 = nothing
std::unique_ptr<DatasetWriter> eth3d_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
