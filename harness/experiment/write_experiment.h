/// Scenario files written out: with overrides put in place, or with all that a generator and a seed made of
/// them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "worlds/visibility/occluders.h"

namespace stereobench::harness {

/// The lines of a scenario with its overrides put in place, faults as the keys that they stand for, mesh
/// files by their absolute paths and, where there is a generator, its balls, walls and tour in its stead.
/// Comments are lost. Read again it is the same world and the same drive, bit for bit.
/// @param seed where there is one, nothing is left to chance: the world as that seed has it, line by line,
///   without jitter and without `randomise:`; the only seed is that one
/// @param occluders reads mesh files, as for read_experiment
/// @throws std::runtime_error, std::invalid_argument as read_experiment
std::string written_out(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                        std::optional<std::uint64_t> seed = std::nullopt,
                        const worlds::OccluderReader& occluders = {});

/// The lines of a scenario with its overrides put in place and faults as the keys that they stand for, and
/// nothing else changed but that comments are lost: files have the names that they have there.
/// @throws std::runtime_error as load_scenario
std::string with_overrides(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The same lines without some of the keys at their top.
std::string without_keys(const std::string& scenario, const std::set<std::string>& keys);

/// The files that a scenario names, each once, as they are named: meshes, textures, paths, noise. Those that
/// lie within a mesh file are not among them.
/// @throws std::runtime_error as load_scenario
std::set<std::string> files_named_in(const std::filesystem::path& file,
                                     const std::vector<std::string>& overrides);

/// Lines of with_overrides, and hashes of hashes_of_named_files.
struct ScenarioLines {
  std::string text;
  std::map<std::string, std::string> files_sha256;
};

/// Both, with the scenario read once.
/// @throws std::runtime_error as the two
ScenarioLines lines_and_files(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// SHA-256 of each of these files, by its name there.
/// @throws std::runtime_error as load_scenario, and when a file cannot be read
std::map<std::string, std::string> hashes_of_named_files(const std::filesystem::path& file,
                                                         const std::vector<std::string>& overrides);

}  // namespace stereobench::harness
