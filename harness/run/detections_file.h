/// Detections that were made elsewhere, in the pictures of a rendered data set.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/types.h"
#include "harness/vision_scoring/vision_score.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What detections in a file are worth, and what became of each.
struct ScoredDetections {
  VisionScore score;
  std::string rows;  ///< lines of detections.csv
};

/// Puts detections in place of a log's sightings, and scores them against the data set's truth.
/// @param log of the data set
/// @param folder that `stereobench render` wrote
/// @param detections lines of detection_lines.h: one for each frame there are pictures of, in order
/// @param identity how filters are to tell landmarks apart; empty: by their colours if no two share one, as
///   colour classes otherwise
/// @param seed that the lines of detections.csv name
/// @throws std::runtime_error "file:line: what was expected" for whatever is not exactly so
ScoredDetections replace_sightings(MeasurementLog& log, const std::filesystem::path& folder,
                                   const std::filesystem::path& detections,
                                   std::optional<worlds::Identity> identity, std::uint64_t seed);

/// Whether a folder is of `stereobench import`, with pictures of which nobody knows what they show.
bool is_imported(const std::filesystem::path& folder);

/// Puts detections in the pictures of an imported folder in place of its log's sightings. There is no truth
/// to score them against.
/// @param log of the folder; a picture is of the step that has its number
/// @param detections as above; each ball has its range, since balls may be of any size
/// @param identity empty: as colour classes
/// @throws std::runtime_error as above
void take_sightings(MeasurementLog& log, const std::filesystem::path& folder,
                    const std::filesystem::path& detections, std::optional<worlds::Identity> identity);

}  // namespace stereobench::harness
