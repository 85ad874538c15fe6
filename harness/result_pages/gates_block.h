/// Limits on a result, and whether it keeps them.
#pragma once

#include <span>

#include <nlohmann/json.hpp>

#include "harness/page/page.h"
#include "harness/regression/gates.h"

namespace stereobench::harness {

/// A table of gates, the broken ones first; those that hold are shown on demand.
/// @param json the result, whose numbers gates name
Block gates_block(std::span<const Gate> gates, const nlohmann::ordered_json& json);

}  // namespace stereobench::harness
