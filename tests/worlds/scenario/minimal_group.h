/// Groups of keys made up from their declaration: as little as each kind needs.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "worlds/yaml/key_group.h"

namespace stereobench::worlds {

/// A group in a scenario: where it is, of which kind, and what must be set for it to be there.
struct Context {
  const KeyGroup* group = nullptr;
  std::string path;              ///< "path", "world.balls[0]"; empty at the top
  std::string kind;              ///< empty: it has none
  std::vector<std::string> set;  ///< the groups above it
  bool is_written = true;        ///< the small scenario has it
};

inline std::string minimal(const KeyGroup& group, const std::string& kind);

/// A value that the declaration allows. @param place makes entries of a list differ
inline std::string sample(const Key& key, int place = 0) {
  if (key.kind == ValueKind::kGroup)
    return minimal(*key.group, key.group->kind_key.empty()
                                   ? ""
                                   : std::string(key.group->find(key.group->kind_key)->names.front()));
  if (key.kind == ValueKind::kFlag) return "true";
  if (key.kind == ValueKind::kText) return "thing.obj";
  if (key.kind == ValueKind::kChoice) return std::string(key.names.front());
  return fmt::format("{}", std::clamp(1.0 + place, key.within.least, key.within.most));
}

inline std::string sample_value(const Key& key) {
  if (key.lengths.single) return sample(key);
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < std::max<std::size_t>(key.lengths.least, 1); ++i) {
    const std::string entry = sample(key, static_cast<int>(3 * i * i));
    if (key.lengths.inner == kAsManyAsEntries) return fmt::format("[[{}]]", entry);
    entries.push_back(
        key.lengths.inner == 0 ? entry : fmt::format("[{}, {}]", entry, sample(key, static_cast<int>(i))));
  }
  return fmt::format("[{}]", fmt::join(entries, ", "));
}

/// The keys that a kind needs, with values that the declaration allows.
/// @param more a key that is written as well, in place of the one that it is an alternative to
inline std::string minimal_with(const KeyGroup& group, const std::string& kind, std::string_view more,
                                const std::string& value) {
  std::vector<std::string> lines;
  for (const Key& key : group.keys) {
    const bool is_kind = key.name == group.kind_key;
    if (key.name == more)
      lines.push_back(fmt::format("{}: {}", key.name, value));
    else if (is_needed(key, kind) && (more.empty() || key.alternative != more))
      lines.push_back(fmt::format("{}: {}", key.name, is_kind ? kind : sample_value(key)));
  }
  return fmt::format("{{{}}}", fmt::join(lines, ", "));
}

inline std::string minimal(const KeyGroup& group, const std::string& kind) {
  return minimal_with(group, kind, "", "");
}

/// Overrides that put a group into the small scenario. @param text the group as YAML
inline std::vector<std::string> overrides_of(const Context& context, const std::string& text) {
  std::vector<std::string> overrides = context.set;
  if (context.path.empty() || context.is_written) return overrides;
  const bool is_entry = context.path.ends_with("[0]");
  overrides.push_back(is_entry ? fmt::format("{}=[{}]", context.path.substr(0, context.path.size() - 3), text)
                               : fmt::format("{}={}", context.path, text));
  return overrides;
}

inline std::string path_of(const Context& context, std::string_view key) {
  return context.path.empty() ? std::string(key) : fmt::format("{}.{}", context.path, key);
}

/// Overrides that give one key of a group a value.
inline std::vector<std::string> overrides_with(const Context& context, const Key& key,
                                               const std::string& value) {
  std::vector<std::string> overrides =
      overrides_of(context, minimal_with(*context.group, context.kind, key.name, value));
  if (context.is_written) overrides.push_back(fmt::format("{}={}", path_of(context, key.name), value));
  return overrides;
}

/// The group and all groups below it, each kind for itself.
inline std::vector<Context> contexts_of(const Context& above) {
  std::vector<Context> contexts = {above};
  for (const Key& key : above.group->keys) {
    if (key.kind != ValueKind::kGroup) continue;
    const KeyGroup& below = *key.group;
    const std::vector<std::string_view> kinds =
        below.kind_key.empty() ? std::vector<std::string_view>{""} : below.find(below.kind_key)->names;
    for (const std::string_view kind : kinds) {
      Context next{&below, path_of(above, key.name) + (key.lengths.single ? "" : "[0]"), std::string(kind)};
      next.set = overrides_of(above, minimal(*above.group, above.kind));
      const bool replaces_another = std::ranges::any_of(
          above.group->keys, [&](const Key& other) { return other.alternative == key.name; });
      if (replaces_another) next.set.push_back(fmt::format("{}={{}}", above.path));
      if (kind == "tour") next.set.push_back("world={generator: {kind: maze}}");
      next.is_written = next.path == "world" || next.path == "world.balls[0]";
      const auto more = contexts_of(next);
      contexts.insert(contexts.end(), more.begin(), more.end());
    }
  }
  return contexts;
}

/// All groups of a scenario. @param top the keys of its file
inline std::vector<Context> all_contexts(const KeyGroup& top) {
  return contexts_of({.group = &top});
}

/// The keys that groups of the context's kind have.
inline std::vector<const Key*> keys_of(const Context& context) {
  std::vector<const Key*> keys;
  for (const Key& key : context.group->keys)
    if (belongs(key, context.kind)) keys.push_back(&key);
  return keys;
}

}  // namespace stereobench::worlds
