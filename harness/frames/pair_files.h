/// Kept pairs as files beside a result, where a comparison finds them again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "harness/frames/kept_pair.h"
#include "vision/types.h"

namespace stereobench::harness {

/// Where a result's pictures are.
inline constexpr const char* kFrames = "frames";

/// Writes frames/seed3_frame0041_left.jpg, its right twin, and frames/calibration.yaml. Those of an earlier
/// run are removed first.
/// @param out folder of the result
/// @param rig the true one, which took the pictures
/// @throws std::runtime_error when a file cannot be written
void write_pairs(const std::filesystem::path& out, std::span<const KeptPair> pairs,
                 const vision::StereoRig& rig);

/// Writes the pictures of one more pair beside them. @throws std::runtime_error when a file cannot be written
void add_pair(const std::filesystem::path& out, const KeptPair& pair);

/// Removes what write_pairs wrote. @param out folder of the result
void remove_pairs(const std::filesystem::path& out);

/// Reads a pair's pictures. @return empty where the result has not kept this pair
std::optional<KeptPair> read_pair(const std::filesystem::path& out, std::uint64_t seed, std::size_t frame);

/// The rig that took the pictures. @return empty where the result has kept none
/// @throws std::runtime_error, one line, for a calibration that cannot be read
std::optional<vision::StereoRig> rig_of_pairs(const std::filesystem::path& out);

}  // namespace stereobench::harness
