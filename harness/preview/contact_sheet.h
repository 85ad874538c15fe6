/// A data set at a glance: some of its pairs on one picture.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"
#include "vision/types.h"
#include "worlds/camera_sensor.h"

namespace stereobench::harness {

/// What a sheet may weigh. Its pairs are drawn smaller until it does.
inline constexpr std::size_t kMostSheetBytes = 1'000'000;

/// Indices of `count` things out of `all`, evenly spaced: the first and the last are among them.
/// @param all, count >= 1 @return min(all, count) indices, ascending
std::vector<std::size_t> evenly_spaced(std::size_t all, std::size_t count);

/// How levels stand for light: what dataset.json says. Of a folder without it nothing is known, and its
/// pictures are shown as they are.
/// @throws std::runtime_error, one line, for a dataset.json that is broken
worlds::Encoding shown_encoding(const std::filesystem::path& folder);

/// A frame's pictures as screens show them: in colours, light that is stored as it is as sRGB.
/// @return CV_8UC3; the right one is empty where the frame has none
/// @throws std::runtime_error, one line, for a picture that is missing or broken
vision::StereoPair shown_pair(const ViewFrame& frame, worlds::Encoding encoding);

/// A row for each of some frames: left and right picture, disparity (or inverse depth, where there is none)
/// and balls, as far as the data set has them, with the frame's name. Colours of disparity are the same for
/// all rows, black is none.
/// @param view at least one frame @param frames indices, at least one
/// @param name of the data set, as the sheet says it
/// @return the bytes of a PNG file, kMostSheetBytes at most
/// @throws std::runtime_error, one line, for a picture that is missing or broken
std::string contact_sheet(const DatasetView& view, const std::vector<std::size_t>& frames,
                          const std::string& name);

}  // namespace stereobench::harness
