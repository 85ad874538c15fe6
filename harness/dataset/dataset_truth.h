/// The truth of a data set that `stereobench render` wrote, read back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "renderer/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What a data set says of itself.
struct DatasetTruth {
  worlds::World world;              ///< its balls and what they are made to, and nothing else
  vision::StereoRig rig;            ///< as it is
  vision::StereoRig believed_rig;   ///< as vision takes it to be
  std::vector<std::size_t> frames;  ///< that there are pictures of, in order; lost ones are not among them
};

/// Reads the balls, the rigs and which frames there are.
/// @throws std::runtime_error, one line, when a file is missing or not as `render` writes it
DatasetTruth read_dataset_truth(const std::filesystem::path& folder);

/// Reads which ball each pixel of a frame shows; colour and depth are left empty.
/// @throws std::runtime_error, one line, when a picture is missing or of another size than the rig's
renderer::StereoFrame read_ball_ids(const std::filesystem::path& folder, std::size_t frame,
                                    const vision::StereoRig& rig);

/// The world of balls.csv: its balls in the order of their ball_id, and what dataset.json says they are made
/// to; where it says nothing, as those of older versions, all balls are exactly of one size.
/// @throws std::runtime_error, one line, as above
worlds::World read_balls(const std::filesystem::path& folder);

/// By how many rows the rig may be off, as dataset.json says; empty where it says nothing.
/// @throws std::runtime_error, one line, as above
std::optional<double> read_rows_within_px(const std::filesystem::path& folder);

}  // namespace stereobench::harness
