#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {
namespace {

std::string joined(const std::string& group, std::string_view key) {
  return group.empty() ? std::string(key) : fmt::format("{}.{}", group, key);
}

/// Holds the default that a reader has against the declared one, which people are told.
void agree(const Key& key, const std::string& fallback) {
  if (key.fallback.empty() || key.fallback == fallback) return;
  throw std::logic_error(
      fmt::format("{}: its declared default is {}, its reader's is {}", key.name, key.fallback, fallback));
}

std::string listed(const std::vector<double>& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string listed(const Key& key, const std::vector<std::size_t>& places) {
  std::vector<std::string_view> names;
  for (const std::size_t place : places) names.push_back(key.names.at(place));
  return fmt::format("[{}]", fmt::join(names, ", "));
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

const Key& YamlMap::declared(std::string_view key) const {
  const Key* const found = group_->find(key);
  if (found == nullptr) throw std::logic_error(fmt::format("the key {} is read and not declared", key));
  return *found;
}

std::optional<YamlValue> YamlMap::find(std::string_view key) const {
  declared(key);
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

std::optional<YamlValue> YamlMap::find_needed(std::string_view key, bool has_fallback) const {
  return has_fallback ? find(key) : at(key);
}

double YamlMap::number(std::string_view key, std::optional<double> fallback) const {
  const auto found = find_needed(key, fallback.has_value());
  if (found) return found->number(declared(key).within);
  agree(declared(key), fmt::format("{}", *fallback));
  return *fallback;
}

int YamlMap::whole(std::string_view key, std::optional<int> fallback) const {
  const auto found = find_needed(key, fallback.has_value());
  const Interval& within = declared(key).within;
  if (found) return found->integer(static_cast<int>(within.least), static_cast<int>(within.most));
  agree(declared(key), fmt::format("{}", *fallback));
  return *fallback;
}

bool YamlMap::flag(std::string_view key, bool fallback) const {
  if (const auto found = find(key)) return found->flag();
  agree(declared(key), fmt::format("{}", fallback));
  return fallback;
}

std::size_t YamlMap::choice(std::string_view key, std::optional<std::size_t> fallback) const {
  const auto found = find_needed(key, fallback.has_value());
  if (found) return found->choice(declared(key).names);
  agree(declared(key), std::string(declared(key).names.at(*fallback)));
  return *fallback;
}

std::vector<double> YamlMap::numbers(std::string_view key, std::vector<double> fallback) const {
  const Key& known = declared(key);
  const auto found = find_needed(key, !fallback.empty());
  if (!found) {
    agree(known, listed(fallback));
    return fallback;
  }
  const auto read = [&](const YamlValue& value) {
    if (known.kind == ValueKind::kNumber) return value.number(known.within);
    const int whole =
        value.integer(static_cast<int>(known.within.least), static_cast<int>(known.within.most));
    return static_cast<double>(whole);
  };
  if (known.lengths.single && !found->is_list()) return std::vector(known.lengths.most, read(*found));
  std::vector<double> numbers;
  for (const YamlValue& entry : found->list(known.lengths.least, known.lengths.most))
    numbers.push_back(read(entry));
  return numbers;
}

std::vector<std::size_t> YamlMap::choices(std::string_view key, std::vector<std::size_t> fallback) const {
  const Key& known = declared(key);
  const auto found = find(key);
  if (!found) {
    agree(known, listed(known, fallback));
    return fallback;
  }
  std::vector<std::size_t> places;
  for (const YamlValue& entry : found->list(known.lengths.least, known.lengths.most))
    places.push_back(entry.choice(known.names));
  return places;
}

std::vector<YamlValue> YamlMap::list(std::string_view key) const {
  const Lengths& lengths = declared(key).lengths;
  const auto found = find(key);
  return found ? found->list(lengths.least, lengths.most) : std::vector<YamlValue>();
}

}  // namespace stereobench::worlds
