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
