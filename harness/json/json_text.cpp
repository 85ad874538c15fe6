#include "harness/json/json_text.h"

#include <algorithm>

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

bool is_plain(const Json& json) {
  return std::ranges::none_of(json, [](const Json& entry) { return entry.is_structured(); });
}

/// "[1, null, 3]"
std::string on_one_line(const Json& list) {
  std::string text;
  for (const Json& entry : list) text += (text.empty() ? "" : ", ") + entry.dump();
  return "[" + text + "]";
}

/// @param indent of the line that it begins on
void append(const Json& json, const std::string& indent, std::string& text) {
  if (json.is_array() && is_plain(json)) {
    text += on_one_line(json);
  } else if (json.is_structured() && !json.empty()) {
    text += json.is_array() ? "[" : "{";
    const std::string deeper = indent + "  ";
    std::string separator = "\n";
    for (const auto& [key, child] : json.items()) {
      text += separator + deeper;
      if (json.is_object()) text += Json(key).dump() + ": ";
      append(child, deeper, text);
      separator = ",\n";
    }
    text += "\n" + indent + (json.is_array() ? "]" : "}");
  } else {
    text += json.dump();
  }
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& json) {
  std::string text;
  append(json, "", text);
  return text + "\n";
}

}  // namespace stereobench::harness
