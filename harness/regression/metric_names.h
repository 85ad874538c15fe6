/// What numbers a result has.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace stereobench::harness {

/// All numbers of a result that gates can name, as dotted paths, in the order of the result.
/// @param result its values do not matter; null stands for a number that does not exist
std::vector<std::string> metric_names(const nlohmann::ordered_json& result);

}  // namespace stereobench::harness
