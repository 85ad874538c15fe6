#include "harness/reference/reference_pages.h"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/fault_presets.h"
#include "harness/run/metric_keys.h"
#include "worlds/yaml/key_group.h"

namespace stereobench::harness {
namespace {

using worlds::Key;
using worlds::KeyGroup;
using worlds::ValueKind;

/// Text for a cell of a table, where a bar would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string_view type_name(ValueKind kind) {
  switch (kind) {
    case ValueKind::kNumber:
      return "number";
    case ValueKind::kWhole:
      return "integer";
    case ValueKind::kText:
      return "text";
    case ValueKind::kFlag:
      return "flag";
    case ValueKind::kChoice:
      return "choice";
    case ValueKind::kGroup:
      break;
  }
  return "group";
}

std::string type_of(const Key& key) {
  const std::string_view name = type_name(key.kind);
  const worlds::Lengths& lengths = key.lengths;
  if (lengths.most == 0) return std::string(name);
  const std::string count = lengths.least == lengths.most
                                ? fmt::format("{}", lengths.most)
                                : fmt::format("{} to {}", lengths.least, lengths.most);
  std::string list = fmt::format("list of {} {}", count, name);
  if (lengths.inner != 0) list = fmt::format("list of {} lists of {} {}", count, lengths.inner, name);
  if (lengths.inner == worlds::kAsManyAsEntries)
    list = fmt::format("square matrix of {} rows of {}", count, name);
  return lengths.single ? fmt::format("{}, or {}", name, list) : list;
}

std::string range_of(const Key& key) {
  if (key.kind == ValueKind::kChoice) return fmt::format("{}", fmt::join(key.names, ", "));
  if (key.kind == ValueKind::kNumber || key.kind == ValueKind::kWhole)
    return fmt::format("{} to {}", key.within.least, key.within.most);
  return {};
}

std::string default_of(const Key& key) {
  if (key.required) {
    if (key.alternative.empty()) return "required";
    return fmt::format("required, or `{}`", key.alternative);
  }
  std::string words;
  if (!key.fallback.empty()) words = fmt::format("`{}`", key.fallback);
  if (!key.fallback_says.empty()) words = key.fallback_says;
  if (!key.same_as.empty()) words = fmt::format("as `{}`", key.same_as);
  if (key.required_for.empty()) return words;
  const std::string needed = fmt::format("required for {}", fmt::join(key.required_for, ", "));
  return words.empty() ? needed : fmt::format("{}; else {}", needed, words);
}

std::string says_of(const Key& key) {
  if (key.kinds.empty()) return key.says;
  return fmt::format("{} Only for {}.", key.says, fmt::join(key.kinds, ", "));
}

void add_group(const KeyGroup& group, const std::string& path, std::string& page) {
  page += fmt::format("\n## {}\n\n", path.empty() ? "Top of the file" : fmt::format("`{}`", path));
  page += "| key | type | unit | range or choices | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : group.keys)
    page += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, type_of(key),
                        unit_of(std::string(key.name)), cell(range_of(key)), cell(default_of(key)),
                        cell(says_of(key)));
  for (const Key& key : group.keys) {
    if (key.kind != ValueKind::kGroup) continue;
    const std::string below = path.empty() ? std::string(key.name) : fmt::format("{}.{}", path, key.name);
    add_group(*key.group, key.lengths.most == 0 ? below : fmt::format("{}[]", below), page);
  }
}

/// The first parts of a metric's path: what its table is headed by.
std::string table_of(const std::string& path) {
  for (const std::string_view deep : {"filters.*.consistency", "filters.*.association", "filters.*.counters"})
    if (path.starts_with(deep)) return std::string(deep);
  const std::size_t end = path.find_first_of(".[");
  return end == std::string::npos ? "" : path.substr(0, end);
}

/// A row for each key that a fault sets; the first one says what is wrong.
std::string rows_of(const FaultPreset& preset) {
  std::string rows;
  std::string name = fmt::format("`{}`", preset.name), says(preset.says);
  for (const FaultSetting& setting : preset.settings) {
    rows += fmt::format("| {} | {} | `{}` | {} |\n", name, says, quantity_of(setting),
                        fmt::join(setting.levels, " | "));
    name.clear();
    says.clear();
  }
  return rows;
}

/// Where the levels of a group's faults are from.
std::string reasons_of(const std::string& group) {
  std::string lines;
  for (const FaultPreset& preset : fault_presets())
    if (preset.name.starts_with(group + ".")) lines += fmt::format("- `{}`: {}\n", preset.name, preset.why);
  return lines;
}

}  // namespace

std::string scenario_reference() {
  std::string page =
      "# Scenario keys\n\n"
      "Made by `stereobench schema --markdown`; do not edit. [scenarios](scenarios.md) explains them.\n";
  add_group(experiment_keys(), "", page);
  return page;
}

std::string metrics_reference() {
  std::vector<std::pair<std::string, std::string>> tables;
  for (const MetricKey& key : metric_keys()) {
    const std::string name = table_of(key.path);
    std::size_t at = 0;
    while (at < tables.size() && tables[at].first != name) ++at;
    if (at == tables.size()) tables.emplace_back(name, "");
    tables[at].second += fmt::format("| `{}` | {} | {} |\n", key.path, unit_of(key.path), cell(key.says));
  }
  std::string page =
      "# Keys of run.json\n\n"
      "Made by `stereobench metrics --markdown`; do not edit. `*` is the name of a filter, `[]` any entry\n"
      "of a list. [filters_and_scores](filters_and_scores.md) explains the scores.\n";
  for (const auto& [name, rows] : tables)
    page += fmt::format("\n## {}\n\n| key | unit | meaning |\n|---|---|---|\n{}",
                        name.empty() ? "Top of the file" : fmt::format("`{}`", name), rows);
  return page;
}

std::string faults_reference() {
  std::string page =
      "# Named faults\n\n"
      "Made by `stereobench faults --markdown`; do not edit. [noise_studies](noise_studies.md#named-faults)\n"
      "explains them. A fault sets the keys in its rows to what stands below its severity.\n";
  for (const Key& group : fault_keys().keys) {
    const std::string name(group.name);
    page += fmt::format("\n## `{}`\n\n{}\n\n", name, group.says);
    page += "| fault | what is wrong | key | 1 | 2 | 3 | 4 | 5 |\n|---|---|---|---|---|---|---|---|\n";
    for (const FaultPreset& preset : fault_presets())
      if (preset.name.starts_with(name + ".")) page += rows_of(preset);
    page += fmt::format("\nWhy these levels:\n\n{}", reasons_of(name));
  }
  return page;
}

}  // namespace stereobench::harness
