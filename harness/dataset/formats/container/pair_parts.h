/// The parts that containers are made of: what is kept of each stereo pair until the whole drive is there.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// Both pictures of a pair, and which balls they show.
std::vector<DatasetFile> pair_parts(DatasetPair& pair);

/// Where a picture's part lies, a PNG. @param folder of the data set
std::filesystem::path picture_part(const std::filesystem::path& folder, std::size_t step, vision::Side side);

/// The balls of which one of the pictures shows a pixel: a list of {"ball_id", "left", "right"}; each camera
/// has px_count_visib and bbox_visib by the names of BOP, or null where it sees none of it.
/// @param folder of the data set
nlohmann::ordered_json visible_balls_part(const std::filesystem::path& folder, std::size_t step);

}  // namespace stereobench::harness
