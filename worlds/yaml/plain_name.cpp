#include "worlds/yaml/plain_name.h"

#include <algorithm>

namespace stereobench::worlds {

std::string plain_name(const YamlValue& value) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  std::string name = value.text();
  if (!std::ranges::all_of(name, is_plain)) value.fail("expected letters, digits, _ and -");
  return name;
}

}  // namespace stereobench::worlds
