#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "worlds/yaml_value.h"

namespace stereobench::worlds {
namespace {

/// Levenshtein's distance: how many letters to insert, drop or change.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// "did you mean x?" when a known key is near, else all that are known.
std::string advice(std::string_view key, std::span<const std::string_view> known) {
  const auto change = [&](std::string_view other) {
    return static_cast<double>(edit_distance(key, other)) / static_cast<double>(other.size());
  };
  const std::string_view nearest = *std::ranges::min_element(known, {}, change);
  if (change(nearest) <= 0.5) return fmt::format("did you mean {}?", nearest);
  return fmt::format("expected one of {}", fmt::join(known, ", "));
}

std::string joined(const std::string& group, std::string_view key) {
  return group.empty() ? std::string(key) : fmt::format("{}.{}", group, key);
}

}  // namespace

YamlMap::YamlMap(const YamlValue& value, std::span<const std::string_view> known) : value_(value) {
  if (!value.node_.IsMap()) value.fail("expected a group of keys");
  std::set<std::string> seen;
  for (const auto& entry : value.node_) {
    if (!entry.first.IsScalar()) value.refuse("expected keys that are plain text");
    const std::string& key = entry.first.Scalar();
    const YamlValue here(*value.document_, joined(value.key_, key), entry.second, entry.first.Mark());
    if (std::ranges::find(known, key) == known.end()) here.refuse("unknown key, " + advice(key, known));
    if (!seen.insert(key).second) here.refuse("expected each key once (this one is repeated)");
  }
}

std::optional<YamlValue> YamlMap::find(std::string_view key) const {
  for (const auto& entry : value_.node_) {
    if (entry.first.Scalar() != key) continue;
    return YamlValue(*value_.document_, joined(value_.key_, key), entry.second, entry.first.Mark());
  }
  return std::nullopt;
}

YamlValue YamlMap::at(std::string_view key) const {
  if (const auto found = find(key)) return *found;
  const YamlValue missing(*value_.document_, joined(value_.key_, key), value_.node_, value_.mark_);
  missing.refuse("this key is missing and has no default");
}

double YamlMap::number(std::string_view key, const Interval& within, std::optional<double> fallback) const {
  const auto found = fallback ? find(key) : at(key);
  return found ? found->number(within) : *fallback;
}

}  // namespace stereobench::worlds
