/// What scenario files may hold, as a JSON Schema that editors can check with.
#pragma once

#include <nlohmann/json.hpp>

#include "worlds/yaml/key_group.h"

namespace stereobench::harness {

/// A JSON Schema (draft 7) of a group of keys, made of their declaration.
///
/// It says all of types, names, ranges, lengths, and which keys are known and needed, by kind. What keys ask
/// of each other (balls that touch, textures beside materials) the reader alone knows: what the schema
/// refuses, the reader refuses too.
nlohmann::ordered_json json_schema(const worlds::KeyGroup& group);

/// The schema of scenario files.
nlohmann::ordered_json scenario_schema();

}  // namespace stereobench::harness
