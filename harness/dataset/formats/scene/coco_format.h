/// COCO's instances, `coco`: which balls each picture shows, and where.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Refuses pictures in which a ball's outline is no ellipse (truth_limits.h): there is no bbox_obj then.
/// @throws std::runtime_error, one line that names the scenario's key
void check_coco_format(const DatasetDrive& drive);

/// Writes pictures and one list of what they show:
///
///     images/left/000000.png, images/right/   pictures of both cameras, named by their step
///     annotations/instances_SCENARIO_SEED.json
///
/// Image 2 s + 1 is the left picture of step s, 2 s + 2 the right one. Category c + 1 is the colour c of the
/// palette. An annotation is a ball of which a picture shows a pixel: `bbox`, `area` and `segmentation` (RLE
/// without compression: columns first, the first run counts zeros) are of the pixels that show it. Beside
/// COCO's keys there are those of BOP (bbox_obj, bbox_visib, px_count_all, px_count_visib, visib_fract), and
/// ball_id and truncated as in the format plain.
std::unique_ptr<DatasetWriter> coco_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
