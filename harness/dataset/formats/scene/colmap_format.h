/// COLMAP's text model, `colmap`: a reconstruction that is the truth.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses what a model has no place for: rigs that vision is told wrong, rows that look one after another.
/// @throws std::runtime_error, one line that names the scenario's key
void check_colmap_format(const DatasetDrive& drive);

/// Writes a project folder:
///
///     images/left/000000.png, images/right/   pictures of both cameras, named by their step
///     sparse/0/cameras.txt     1 = left, 2 = right: PINHOLE, OPENCV, or FULL_OPENCV where the lens has k3
///     sparse/0/images.txt      camera_from_world of each picture (w x y z), and the ball centres that it shows
///     sparse/0/points3D.txt    the ball centres, and which pictures show them
///
/// The first pixel's centre is (0.5, 0.5). Image 2 s + 1 is the left picture of step s, 2 s + 2 the right
/// one. Point b + 1 is the centre of ball b. It is observed where the picture shows a pixel of the ball and
/// the centre's projection, which is not the outline's centre, lies in the picture. A ball that is never
/// observed is no point.
std::unique_ptr<DatasetWriter> colmap_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
