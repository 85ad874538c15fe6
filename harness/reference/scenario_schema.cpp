#include "harness/reference/scenario_schema.h"

#include <fmt/format.h>

#include "harness/experiment/experiment.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using worlds::Key;
using worlds::KeyGroup;
using worlds::ValueKind;

Json text_schema(const Key& key) {
  Json schema = {{"type", {"string", "number", "boolean"}}, {"minLength", 1}};  // any value is text as well
  if (!key.pattern.empty()) schema["pattern"] = key.pattern;
  return schema;
}

/// One value, without a list around it.
Json single_schema(const Key& key) {
  switch (key.kind) {
    case ValueKind::kNumber:
      return {{"type", "number"}, {"minimum", key.within.least}, {"maximum", key.within.most}};
    case ValueKind::kWhole:
      return {{"type", "integer"},
              {"minimum", static_cast<long>(key.within.least)},
              {"maximum", static_cast<long>(key.within.most)}};
    case ValueKind::kText:
      return text_schema(key);
    case ValueKind::kFlag:
      return {{"type", "boolean"}};
    case ValueKind::kChoice:
      return {{"enum", key.names}};
    case ValueKind::kGroup:
      break;
  }
  return json_schema(*key.group);
}

Json list_schema(const Json& entry, std::size_t least, std::size_t most) {
  return {{"type", "array"}, {"items", entry}, {"minItems", least}, {"maxItems", most}};
}

Json value_schema(const Key& key) {
  const Json single = single_schema(key);
  const worlds::Lengths& lengths = key.lengths;
  if (lengths.most == 0) return single;
  const Json entry = lengths.inner == worlds::kAsManyAsEntries
                         ? list_schema(single, lengths.least, lengths.most)
                     : lengths.inner == 0 ? single
                                          : list_schema(single, lengths.inner, lengths.inner);
  const Json list = list_schema(entry, lengths.least, lengths.most);
  return lengths.single ? Json{{"anyOf", Json::array({single, list})}} : list;
}

/// A declared default is YAML of numbers, flags, names and lists of these.
Json default_of(const std::string& yaml) {
  if (Json value = Json::parse(yaml, nullptr, false); !value.is_discarded()) return value;
  if (!yaml.starts_with("[")) return yaml;
  Json names = Json::array();
  for (std::size_t begin = 1; begin < yaml.size();) {
    const std::size_t end = yaml.find_first_of(",]", begin);
    names.push_back(yaml.substr(begin, end - begin));
    begin = end + 2;
  }
  return names;
}

Json described(const Key& key) {
  Json schema = value_schema(key);
  std::string says = key.says;
  if (!key.fallback_says.empty()) says += fmt::format(" Otherwise: {}.", key.fallback_says);
  if (!key.same_as.empty()) says += fmt::format(" Otherwise as {}.", key.same_as);
  schema["description"] = says;
  if (!key.fallback.empty()) schema["default"] = default_of(key.fallback);
  return schema;
}

/// What one kind of a group needs and does not have.
Json rules_of_kind(const KeyGroup& group, std::string_view kind) {
  Json needed = Json::array();
  Json strange = Json::object();
  for (const Key& key : group.keys) {
    if (!belongs(key, kind)) strange[std::string(key.name)] = false;
    if (is_needed(key, kind) && !is_needed(key, "")) needed.push_back(key.name);
  }
  return {
      {"if",
       {{"properties", {{std::string(group.kind_key), {{"const", kind}}}}}, {"required", {group.kind_key}}}},
      {"then", {{"required", needed}, {"properties", strange}}}};
}

Json rules_of(const KeyGroup& group) {
  Json rules = Json::array();
  for (const Key& key : group.keys)
    if (!key.alternative.empty())
      rules.push_back({{"oneOf", {{{"required", {key.name}}}, {{"required", {key.alternative}}}}}});
  if (group.kind_key.empty()) return rules;
  for (const std::string_view kind : group.find(group.kind_key)->names)
    rules.push_back(rules_of_kind(group, kind));
  return rules;
}

}  // namespace

Json json_schema(const KeyGroup& group) {
  Json properties = Json::object();
  Json needed = Json::array();
  for (const Key& key : group.keys) {
    properties[std::string(key.name)] = described(key);
    if (is_needed(key, "") && key.alternative.empty()) needed.push_back(key.name);
  }
  Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!needed.empty()) schema["required"] = std::move(needed);
  if (Json rules = rules_of(group); !rules.empty()) schema["allOf"] = std::move(rules);
  return schema;
}

Json scenario_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "A scenario of stereobench"}};
  schema.update(json_schema(experiment_keys()));
  return schema;
}

}  // namespace stereobench::harness
