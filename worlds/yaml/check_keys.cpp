#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "worlds/yaml/advice.h"
#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {
namespace {

/// Collects a line for each key that should not be there, or should.
class KeyCheck {
 public:
  void check(const YamlValue& value, const KeyGroup& group) {
    if (!value.is_group()) return;  // which its reader refuses
    const YamlMap map(value, group);
    const std::string kind = kind_of(map, group);
    Names present;  // or meant by what is misspelt
    for (const auto& [name, entry] : map.entries()) {
      const Key* const key = group.find(name);
      if (key == nullptr || !belongs(*key, kind)) {
        const auto names = names_of(group, kind);
        complain(entry, "unknown key, " + advice(name, names));
        if (const auto meant = nearest_word(name, names)) present.insert(*meant);
      } else if (!present.insert(name).second) {
        complain(entry, "expected each key once (this one is repeated)");
      } else if (key->group != nullptr) {
        descend(entry, *key);
      }
    }
    for (const Key& key : group.keys)
      if (is_needed(key, kind) && !present.contains(key.name)) miss(value, key, present);
  }

  /// @return the first complaints, a line each, and how many more there are
  std::string complaints() const {
    constexpr std::size_t kShown = 20;
    const std::size_t shown = std::min(complaints_.size(), kShown);
    std::string text = fmt::format(
        "{}", fmt::join(complaints_.begin(), complaints_.begin() + static_cast<long>(shown), "\n"));
    if (shown < complaints_.size()) text += fmt::format("\nand {} more", complaints_.size() - shown);
    return text;
  }

 private:
  using Names = std::set<std::string, std::less<>>;

  static std::string kind_of(const YamlMap& map, const KeyGroup& group) {
    if (group.kind_key.empty()) return {};
    const auto kind = map.find(group.kind_key);
    const std::string name = kind ? kind->scalar() : std::string();
    const auto& names = group.find(group.kind_key)->names;
    return std::find(names.begin(), names.end(), name) == names.end() ? std::string() : name;
  }

  static std::vector<std::string_view> names_of(const KeyGroup& group, const std::string& kind) {
    std::vector<std::string_view> names;
    for (const Key& key : group.keys)
      if (belongs(key, kind)) names.push_back(key.name);
    return names;
  }

  void descend(const YamlValue& value, const Key& key) {
    if (key.lengths.single || !value.is_list()) return check(value, *key.group);
    if (value.size() > key.lengths.most) return;  // which its reader refuses
    for (const YamlValue& entry : value.list(0, key.lengths.most)) check(entry, *key.group);
  }

  void miss(const YamlValue& group, const Key& key, const Names& present) {
    if (key.alternative.empty())
      complain(group.at_key(key.name), "this key is missing and has no default");
    else if (!present.contains(key.alternative))
      complain(group, fmt::format("expected either {} or {}", key.name, key.alternative));
  }

  void complain(const YamlValue& value, const std::string& what) {
    complaints_.push_back(fmt::format("{}: {}", value.place(), what));
  }

  std::vector<std::string> complaints_;
};

}  // namespace

void check_keys(const YamlValue& value, const KeyGroup& group) {
  KeyCheck check;
  check.check(value, group);
  const std::string complaints = check.complaints();
  if (!complaints.empty()) throw std::runtime_error(complaints);
}

}  // namespace stereobench::worlds
