/// JSON for people and for version control: one key a line, and lists of plain values on one line.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace stereobench::harness {

/// Writes JSON with two spaces a level. A list without lists or objects in it stands on one line.
/// @return lines, the last of them ended
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace stereobench::harness
