#include "worlds/yaml/key_group.h"

#include <algorithm>
#include <utility>

namespace stereobench::worlds {
namespace {

Key key_of(std::string_view name, ValueKind kind, std::string_view says) {
  Key key;
  key.name = name;
  key.kind = kind;
  key.says = says;
  return key;
}

bool contains(const std::vector<std::string_view>& list, std::string_view word) {
  return std::ranges::find(list, word) != list.end();
}

}  // namespace

Key number(std::string_view name, const Interval& within, std::string_view says) {
  Key key = key_of(name, ValueKind::kNumber, says);
  key.within = within;
  return key;
}

Key whole(std::string_view name, int least, int most, std::string_view says) {
  Key key = key_of(name, ValueKind::kWhole, says);
  key.within = {static_cast<double>(least), static_cast<double>(most)};
  return key;
}

Key text(std::string_view name, std::string_view says, std::string_view pattern) {
  Key key = key_of(name, ValueKind::kText, says);
  key.pattern = pattern;
  return key;
}

Key flag(std::string_view name, std::string_view says) {
  return key_of(name, ValueKind::kFlag, says);
}

Key choice(std::string_view name, std::vector<std::string_view> names, std::string_view says) {
  Key key = key_of(name, ValueKind::kChoice, says);
  key.names = std::move(names);
  return key;
}

Key group(std::string_view name, const KeyGroup& keys, std::string_view says) {
  Key key = key_of(name, ValueKind::kGroup, says);
  key.group = &keys;
  return key;
}

Key Key::needed() const {
  Key key = *this;
  key.required = true;
  return key;
}

Key Key::needed_unless(std::string_view other) const {
  Key key = needed();
  key.alternative = other;
  return key;
}

Key Key::needed_for(std::vector<std::string_view> some_kinds) const {
  Key key = *this;
  key.required_for = std::move(some_kinds);
  return key;
}

Key Key::only_for(std::vector<std::string_view> some_kinds) const {
  Key key = *this;
  key.kinds = std::move(some_kinds);
  return key;
}

Key Key::otherwise_says(std::string_view words) const {
  Key key = *this;
  key.fallback_says = words;
  return key;
}

Key Key::otherwise_as(std::string_view path) const {
  Key key = *this;
  key.same_as = path;
  return key;
}

Key Key::written_if_changed() const {
  Key key = *this;
  key.omits_default = true;
  return key;
}

Key Key::times(double factor) const {
  Key key = *this;
  key.unit = factor;
  return key;
}

Key Key::starting_at(int enumerator) const {
  Key key = *this;
  key.first = enumerator;
  return key;
}

Key Key::vector(std::size_t length) const {
  return list(length, length);
}

Key Key::or_vector(std::size_t length) const {
  Key key = vector(length);
  key.lengths.single = true;
  return key;
}

Key Key::list(std::size_t least, std::size_t most, std::size_t inner) const {
  Key key = *this;
  key.lengths = {.single = false, .least = least, .most = most, .inner = inner};
  return key;
}

const Key* KeyGroup::find(std::string_view name) const {
  const auto found = std::ranges::find(keys, name, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

bool belongs(const Key& key, std::string_view kind) {
  return kind.empty() || key.kinds.empty() || contains(key.kinds, kind);
}

bool is_needed(const Key& key, std::string_view kind) {
  const bool here = kind.empty() ? key.kinds.empty() : belongs(key, kind);
  return here && (key.required || contains(key.required_for, kind));
}

const Key* declared_key(const KeyGroup& top, std::string_view path) {
  const KeyGroup* within = &top;
  while (within != nullptr) {
    const std::size_t dot = path.find('.');
    const std::string_view part = path.substr(0, dot);
    const Key* const key = within->find(part.substr(0, part.find('[')));
    if (key == nullptr || dot == std::string_view::npos) return key;
    path.remove_prefix(dot + 1);
    within = key->group;
  }
  return nullptr;
}

}  // namespace stereobench::worlds
