/// Which frames of a data set are imported, and what they are called then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Frames of one drive, or pairs of one rig.
struct ImportedFrames {
  std::vector<ViewFrame> frames;     ///< in order; both pictures where `are_pairs`, else the left one
  std::vector<std::size_t> numbers;  ///< what their files are called: 12 for 000012.png
  bool are_pairs = false;
  bool have_times = false;
  std::size_t left_out = 0;  ///< that had one picture of two, or none
};

/// Takes the frames that have their pictures. Those with times are numbered from 0; pairs without times keep
/// the number that they are named by.
/// @param only name of a sequence, a scene or a frame: what is called so, or lies below a folder of this
/// name;
///   empty: all
/// @throws std::runtime_error, one line, where there are none, or they are of several drives or rigs
ImportedFrames frames_to_import(const DatasetView& view, const std::string& only);

/// Leaves out what is before the first true pose and after the last one, and numbers the others from 0.
/// @throws std::runtime_error, one line, where there are no times or poses, or one between them is missing
void keep_frames_with_poses(const DatasetView& view, ImportedFrames& imported);

}  // namespace stereobench::harness
