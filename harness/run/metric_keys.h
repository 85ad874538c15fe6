/// What the keys of run.json mean: one line for each, for people and for a test that holds it against
/// results.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace stereobench::harness {

/// A key of run.json.
struct MetricKey {
  std::string path;  ///< keys joined by dots; `*` is the name of a filter, `[]` any entry of a list
  std::string says;  ///< one sentence
};

/// All keys of run.json that have a value: numbers, text, and null where there is none.
std::vector<MetricKey> metric_keys();

/// The unit that a key's suffix says, e.g. "m" or "m/s"; empty where it says none.
std::string unit_of(const std::string& path);

/// The keys that a run.json has, each once, as metric_keys() writes them.
std::vector<std::string> keys_in(const nlohmann::ordered_json& run);

}  // namespace stereobench::harness
