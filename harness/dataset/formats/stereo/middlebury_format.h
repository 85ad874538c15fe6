/// The layout of Middlebury's stereo data sets of 2014, `middlebury`: a folder a pair.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what the layout has no place for: rigs that are not rectified or believed to be others, and
/// cameras that look at different times or row by row.
/// @throws std::runtime_error, one line that names the scenario's key
void check_middlebury_format(const DatasetDrive& drive);

/// Writes a folder for each stereo pair, named by its step:
///
///     000000/im0.png, im1.png                the left and the right picture
///     000000/disp0.pfm, disp1.pfm            their disparities, px; +inf = nothing
///     000000/mask0nocc.png, mask1nocc.png    255 = both cameras see it, 128 = this one alone, 0 = nothing
///     000000/calib.txt                       cam0, cam1, doffs, baseline in mm, size, range of disparities
std::unique_ptr<DatasetWriter> middlebury_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
