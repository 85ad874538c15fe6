#include "worlds/yaml/field_values.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace stereobench::worlds {

void read_value(const YamlValue& value, const Key& key, double& number) {
  if (key.kind == ValueKind::kNumber) {
    number = value.number(key.within) * key.unit;
    return;
  }
  int whole = 0;
  read_value(value, key, whole);
  number = whole;
}

void read_value(const YamlValue& value, const Key& key, int& number) {
  number = value.integer(static_cast<int>(key.within.least), static_cast<int>(key.within.most));
}

void read_value(const YamlValue& value, const Key& key, std::uint64_t& number) {
  int whole = 0;
  read_value(value, key, whole);
  number = static_cast<std::uint64_t>(whole);
}

void read_value(const YamlValue& value, const Key&, bool& flag) {
  flag = value.flag();
}

void read_value(const YamlValue& value, const Key&, std::string& text) {
  text = value.text();
}

YAML::Node written(const Key& key, double number) {
  return YAML::Node(fmt::format("{}", number / key.unit));  // the fewest digits that are read back as it
}

YAML::Node written(const Key&, int number) {
  return YAML::Node(number);
}

YAML::Node written(const Key&, std::uint64_t number) {
  return YAML::Node(number);
}

YAML::Node written(const Key&, bool flag) {
  return YAML::Node(flag);
}

YAML::Node written(const Key&, const std::string& text) {
  return text.empty() ? YAML::Node() : YAML::Node(text);
}

YAML::Node flow_list(const std::vector<YAML::Node>& entries) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const YAML::Node& entry : entries) list.push_back(entry);
  list.SetStyle(YAML::EmitterStyle::Flow);
  return list;
}

std::string one_line(const YAML::Node& node) {
  if (!node.IsSequence()) return node.IsScalar() ? node.Scalar() : std::string();
  std::vector<std::string> entries;
  for (const YAML::Node& entry : node) entries.push_back(one_line(entry));
  return fmt::format("[{}]", fmt::join(entries, ", "));
}

}  // namespace stereobench::worlds
