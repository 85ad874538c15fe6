/// Scenarios: what can be seen and how the robot moves, read from strict YAML.
///
/// The file may hold keys of others beside these, whose reader puts the two tables together
/// (harness/experiment/experiment.h).
#pragma once

#include <cstdint>

#include "worlds/types.h"
#include "worlds/visibility/occluders.h"
#include "worlds/yaml/fields.h"

namespace stereobench::worlds {

/// The keys of a scenario at the top of its file, and below them all others. `randomise`, `path` and `world`
/// are declared here and read by read_world_and_path.
const Fields<Scenario>& scenario_keys();

/// Reads what needs the other keys to be read before: `randomise`, `path` and `world`. The path is driven
/// (poses and exact controls), and a generator's world is made.
/// @param top the whole file, whose keys are checked (check_keys)
/// @param occluders reads mesh files; asked only where a generator, or things that are scattered, must know
/// of them
/// @param scenario what scenario_keys() has read
/// @throws std::runtime_error of one line, "file:line: key.path: expected ... (got ...)", also where the
///   world breaks the promises of its `identity`
/// @throws std::invalid_argument when there is no such reader and it would be asked
void read_world_and_path(const YamlMap& top, const OccluderReader& occluders, Scenario& scenario);

/// The world of one seed (randomise.h): the scenario's, with each ball moved by a uniform draw of up to
/// +-placement_jitter_m in x and in y, made as exactly as `ball_radius_sd_m` says (its lowest point stays
/// where it is), and with what `randomise:` draws. Each ball has streams of its own, so adding one moves no
/// other.
///
/// @return exactly scenario.world when jitter and tolerance are 0 and nothing is left to chance
World world_for_seed(const Scenario& scenario, std::uint64_t seed);

}  // namespace stereobench::worlds
