/// Worlds written out, so that what a generator made can be edited.
#pragma once

#include <cstdint>
#include <optional>

#include "worlds/types.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::worlds {

/// Puts the world of a scenario into its document: files by their absolute paths and, where there is a
/// generator, its balls, walls and tour in its stead. Read again it is the same world and the same drive, bit
/// for bit. Keys of others stay as they are.
/// @param scenario as read from that document
/// @param seed where there is one, nothing is left to chance: the world as that seed has it, line by line,
///   without jitter and without `randomise:`
void write_world(const Scenario& scenario, std::optional<std::uint64_t> seed, YamlDocument& document);

/// Makes the `file` of a group absolute, where it has one: what is written may lie in another folder than
/// what was read.
void name_file_from_anywhere(const YamlDocument& document, YAML::Node group);

}  // namespace stereobench::worlds
