#include "harness/experiment/scenario_file.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/fault_presets.h"
#include "worlds/yaml/field_values.h"
#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {
namespace {

using worlds::Key;
using worlds::YamlDocument;
using worlds::YamlMap;
using worlds::YamlValue;

/// "camera.defocus_sd_px" as ("camera", "defocus_sd_px").
std::pair<std::string, std::string> group_and_key(std::string_view path) {
  const std::size_t dot = path.find('.');
  return {std::string(path.substr(0, dot)), std::string(path.substr(dot + 1))};
}

YamlMap top_of(const YamlDocument& document) {
  return {YamlValue(document, "", document.root, document.root.Mark()), experiment_keys()};
}

/// @param path of a key in a group at the top of the file, or in a group of `top`
/// @return what is written there
std::optional<YamlValue> written_at(const YamlMap& top, const worlds::KeyGroup& keys, std::string_view path) {
  const auto [name, key] = group_and_key(path);
  const auto group = top.find(name);
  if (!group) return std::nullopt;
  return YamlMap(*group, *keys.find(name)->group).find(key);
}

std::vector<double> numbers_in(const YamlValue& value, const Key& key) {
  if (key.lengths.most == 0) return {value.number(key.within)};
  std::vector<double> numbers;
  for (const YamlValue& entry : value.list(key.lengths.least, key.lengths.most))
    numbers.push_back(entry.number(key.within));
  return numbers;
}

std::vector<double> numbers_in(const YAML::Node& constant) {
  if (constant.IsScalar()) return {constant.as<double>()};
  return constant.as<std::vector<double>>();
}

/// What the rig really has, of a key that says what is believed of it.
std::vector<double> truth_of(const Key& believed, const YamlDocument& document) {
  const Key& key = *worlds::declared_key(experiment_keys(), believed.same_as);
  const YamlMap top = top_of(document);
  if (const auto written = written_at(top, experiment_keys(), believed.same_as))
    return numbers_in(*written, key);
  if (key.fallback.empty())  // of a sensor that there is not, whose keys nobody could check
    top.value().at_key(believed.same_as).refuse("this key is missing and has no default");
  return numbers_in(worlds::parse_yaml(key.fallback).front());
}

/// @param severity at least 1
YAML::Node value_of(const FaultSetting& setting, int severity, const YamlDocument& document) {
  const std::string_view text = setting.levels.at(static_cast<std::size_t>(severity - 1));
  const YAML::Node level = worlds::parse_yaml(std::string(text)).front();
  if (setting.is == LevelIs::kValue) return level;
  const Key& key = *worlds::declared_key(experiment_keys(), setting.key);
  const std::vector<double> changes = numbers_in(level), truths = truth_of(key, document);
  std::vector<YAML::Node> entries;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const bool is_factor = setting.is == LevelIs::kFactorOnTruth;
    entries.push_back(written(Key{}, is_factor ? changes[i] * truths[i] : changes[i] + truths[i]));
  }
  return level.IsScalar() ? entries.front() : worlds::flow_list(entries);
}

/// Refuses a key that somebody else sets as well.
/// @param fault the severity as it is written
void check_alone(const std::string& key, const YamlValue& fault, const YamlDocument& document) {
  const auto refuse = [&](const std::string& other) {
    fault.refuse(fmt::format("it stands for {}, which {} sets as well; expected one of the two", key, other));
  };
  if (const auto found = document.put_by.find(key); found != document.put_by.end()) refuse(found->second);
  const bool is_there = written_at(top_of(document), experiment_keys(), key).has_value();
  for (const std::string& overridden : document.overridden)
    if (worlds::lies_within(overridden, key) || (is_there && worlds::lies_within(key, overridden)))
      refuse("--set " + overridden);
}

void put(const FaultSetting& setting, int severity, const YamlValue& fault, YamlDocument& document) {
  const std::string path(setting.key);
  check_alone(path, fault, document);
  const YAML::Node value = value_of(setting, severity, document);
  const auto [group, key] = group_and_key(path);
  document.root[group][key] = value;
  document.put_by[path] = fault.place();
}

/// @param severity as it is written
void put(const FaultPreset& preset, const YamlValue& severity, YamlDocument& document) {
  const int level = severity.integer(0, kMostSeverity);
  const auto sensor = top_of(document).find("sensor");
  if (level > 0 && is_of_cameras(preset) && sensor && sensor->scalar() == "oracle")
    severity.refuse("this fault is of cameras, and the oracle has none");
  if (level == 0) return;
  for (const FaultSetting& setting : preset.settings) put(setting, level, severity, document);
}

}  // namespace

YamlDocument load_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  YamlDocument document = worlds::load_yaml(file, overrides, experiment_keys());
  const YamlMap top = top_of(document);
  const auto faults = top.find("faults");
  if (!faults) return document;
  check_keys(top.value(), experiment_keys());
  const YamlMap named(*faults, fault_keys());
  for (const FaultPreset& preset : fault_presets())
    if (const auto severity = written_at(named, fault_keys(), preset.name)) put(preset, *severity, document);
  document.root.remove("faults");
  return document;
}

std::vector<std::string> without_fault_names(const std::filesystem::path& file,
                                             const std::vector<std::string>& overrides) {
  const YamlDocument document = load_scenario(file, overrides);
  if (document.put_by.empty()) return overrides;
  std::vector<std::string> plain = {"faults={}"};
  for (const std::string& line : overrides)
    if (!line.starts_with("faults.") && !line.starts_with("faults=")) plain.push_back(line);
  for (const auto& [path, place] : document.put_by) {
    const auto [group, key] = group_and_key(path);
    YAML::Node value = YAML::Clone(document.root[group][key]);
    if (!value.IsScalar()) value.SetStyle(YAML::EmitterStyle::Flow);
    plain.push_back(path + "=" + YAML::Dump(value));
  }
  return plain;
}

}  // namespace stereobench::harness
