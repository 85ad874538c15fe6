/// Scenario files: everything a run is made from, read from strict YAML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "worlds/types.h"
#include "worlds/visibility/occluders.h"

namespace stereobench::worlds {

/// Reads a scenario file, with some of its values replaced.
///
/// Strict: an unknown or repeated key, a wrong type, a value that is out of range or not finite, a required
/// key or a mesh file that is missing, and a world that breaks the promises of its `identity` are all errors.
///
/// @param file the YAML file; paths of meshes in it are relative to its folder
/// @param overrides "key.path=value", put in place before reading, e.g. "camera.noise_sd_levels=4"; a list is
///        replaced whole
/// @param occluders reads mesh files; asked only where a generator, or things that are scattered, must know
/// of them
/// @return the scenario, its path already driven (poses and exact controls)
/// @throws std::runtime_error of one line, "file:line: key.path: expected ... (got ...)", or
///         "--set key.path: ..." when an override is to blame
/// @throws std::invalid_argument when there is no such reader and it would be asked
Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                       const OccluderReader& occluders = {});

/// The world of one seed (randomise.h): the scenario's, with each ball moved by a uniform draw of up to
/// +-placement_jitter_m in x and in y, made as exactly as `ball_radius_sd_m` says (its lowest point stays
/// where it is), and with what `randomise:` draws. Each ball has streams of its own, so adding one moves no
/// other.
///
/// @return exactly scenario.world when jitter and tolerance are 0 and nothing is left to chance
World world_for_seed(const Scenario& scenario, std::uint64_t seed);

}  // namespace stereobench::worlds
