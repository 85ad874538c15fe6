#include <stdexcept>

#include <fmt/format.h>

#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {
namespace {

std::string joined(const std::string& group, std::string_view key) {
  return group.empty() ? std::string(key) : fmt::format("{}.{}", group, key);
}

}  // namespace

YamlValue YamlValue::at_key(std::string_view key) const {
  return YamlValue(*document_, joined(key_, key), node_, mark_);
}

YamlMap::YamlMap(const YamlValue& value, const KeyGroup& group) : value_(value), group_(&group) {
  if (!value.is_group()) value.fail("expected a group of keys");
}

std::vector<std::pair<std::string, YamlValue>> YamlMap::entries() const {
  std::vector<std::pair<std::string, YamlValue>> entries;
  for (const auto& entry : value_.node_) {
    if (!entry.first.IsScalar()) value_.refuse("expected keys that are plain text");
    const std::string& key = entry.first.Scalar();
    entries.emplace_back(
        key, YamlValue(*value_.document_, joined(value_.key_, key), entry.second, entry.first.Mark()));
  }
  return entries;
}

std::optional<YamlValue> YamlMap::find(std::string_view key) const {
  if (group_->find(key) == nullptr)
    throw std::logic_error(fmt::format("the key {} is read and not declared", key));
  for (const auto& entry : value_.node_) {
    if (entry.first.Scalar() != key) continue;
    return YamlValue(*value_.document_, joined(value_.key_, key), entry.second, entry.first.Mark());
  }
  return std::nullopt;
}

YamlValue YamlMap::at(std::string_view key) const {
  if (const auto found = find(key)) return *found;
  value_.at_key(key).refuse("this key is missing and has no default");
}

}  // namespace stereobench::worlds
