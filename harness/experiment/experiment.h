/// Scenario files: everything a run is made from, read from strict YAML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/experiment/types.h"
#include "worlds/visibility/occluders.h"
#include "worlds/yaml/key_group.h"

namespace stereobench::harness {

/// The keys at the top of a scenario file, and below them all others: those of worlds, and what is run.
const worlds::KeyGroup& experiment_keys();

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
/// @return the experiment, its scenario's path already driven (poses and exact controls)
/// @throws std::runtime_error of one line, "file:line: key.path: expected ... (got ...)", or
///         "--set key.path: ..." when an override is to blame; of a line for each unknown or missing key
/// @throws std::invalid_argument when there is no such reader and it would be asked
Experiment read_experiment(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                           const worlds::OccluderReader& occluders = {});

}  // namespace stereobench::harness
