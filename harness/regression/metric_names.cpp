#include "harness/regression/metric_names.h"

namespace stereobench::harness {
namespace {

void append_names(const nlohmann::ordered_json& json, const std::string& path,
                  std::vector<std::string>& names) {
  if (json.is_number() || json.is_null()) names.push_back(path);
  if (!json.is_object()) return;
  for (const auto& [key, child] : json.items())
    append_names(child, path.empty() ? key : path + "." + key, names);
}

}  // namespace

std::vector<std::string> metric_names(const nlohmann::ordered_json& result) {
  std::vector<std::string> names;
  append_names(result, "", names);
  return names;
}

}  // namespace stereobench::harness
