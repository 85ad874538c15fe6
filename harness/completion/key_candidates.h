/// Keys of YAML files with their values, as `--set KEY=VALUE` takes them.
#pragma once

#include <string_view>
#include <vector>

#include "harness/completion/candidate.h"
#include "worlds/yaml/key_group.h"

namespace stereobench::harness {

/// One group at a time: "cam" gives "camera.", "camera." its keys, "camera.gain=" the values of the key as
/// far as they can be listed.
/// @param word "camera.ga", "path.kind=ci"; behind '=' also a list, "filters=[ekf,uf" or "filters=ekf,uf"
std::vector<Candidate> key_candidates(const worlds::KeyGroup& top, std::string_view word);

}  // namespace stereobench::harness
