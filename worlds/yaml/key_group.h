/// What the keys of a scenario file are.
///
/// Each key is declared once, with the member of a struct that it fills (fields.h). Readers and writers walk
/// the table; complaints about unknown and missing keys, the JSON Schema and the reference page are made of
/// it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace YAML {
class Node;
}

namespace stereobench::worlds {

/// The finite numbers between two bounds, both included.
struct Interval {
  double least = 0.0;
  double most = 0.0;
};

enum class ValueKind { kNumber, kWhole, kText, kFlag, kChoice, kGroup };

struct KeyGroup;
class YamlValue;
template <class Struct>
struct Field;

/// Of Lengths::inner: as many as there are entries.
inline constexpr std::size_t kAsManyAsEntries = static_cast<std::size_t>(-1);

/// How many values a key takes: one, a list of them, or either.
struct Lengths {
  bool single = true;     ///< one value without a list
  std::size_t least = 0;  ///< entries of a list, where `most` is not 0
  std::size_t most = 0;   ///< 0: no list
  std::size_t inner = 0;  ///< not 0: each entry is itself a list of so many numbers
};

/// One key of a group, with what it may hold.
struct Key {
  std::string_view name;
  ValueKind kind = ValueKind::kNumber;
  std::string says;                     ///< one sentence: what it is
  Interval within = {};                 ///< of kNumber and kWhole
  double unit = 1.0;                    ///< of kNumber: the value of 1 in the member's unit
  std::vector<std::string_view> names;  ///< of kChoice
  int first = 0;                        ///< of kChoice: the enumerator that the first name stands for
  std::string_view pattern;             ///< of kText: a regular expression, or empty
  const KeyGroup* group = nullptr;      ///< of kGroup
  Lengths lengths;
  bool required = false;
  std::vector<std::string_view> kinds;         ///< of the group that have this key; empty: all
  std::vector<std::string_view> required_for;  ///< kinds of the group that need it
  std::string_view alternative;                ///< the key that may stand in place of this required one
  std::string fallback;                        ///< its value where it is left out, as YAML
  std::string fallback_says;                   ///< the same in words, where it is no constant
  std::string same_as;                         ///< path of the key whose value it has where it is left out
  bool omits_default = false;                  ///< is written only where its value is not the default

  using Kinds = std::vector<std::string_view>;

  /// Required, whatever the kind.
  Key needed() const { return with(&Key::required, true); }
  /// Required where `other` is left out.
  Key needed_unless(std::string_view other) const { return needed().with(&Key::alternative, other); }
  /// Required for these kinds.
  Key needed_for(const Kinds& some_kinds) const { return with(&Key::required_for, some_kinds); }
  /// Unknown to other kinds.
  Key only_for(const Kinds& some_kinds) const { return with(&Key::kinds, some_kinds); }
  /// A default that depends on other things, in words.
  Key otherwise_says(const std::string& words) const { return with(&Key::fallback_says, words); }
  /// The value of another key.
  Key otherwise_as(const std::string& path) const { return with(&Key::same_as, path); }
  /// Left out of what is written where its value is the default.
  Key written_if_changed() const { return with(&Key::omits_default, true); }
  /// Its member holds factor x the number.
  Key times(double factor) const { return with(&Key::unit, factor); }
  /// A list of exactly so many.
  Key vector(std::size_t length) const { return list(length, length); }
  /// One value, or a list of so many.
  Key or_vector(std::size_t length) const { return with(&Key::lengths, {true, length, length, 0}); }
  /// @param inner not 0: each entry is a list of so many
  Key list(std::size_t least, std::size_t most, std::size_t inner = 0) const {
    return with(&Key::lengths, {false, least, most, inner});
  }
  /// A square matrix: a list of rows.
  Key square(std::size_t most) const { return list(1, most, kAsManyAsEntries); }
  /// The enumerator that the first name stands for.
  Key starting_at(int enumerator) const { return with(&Key::first, enumerator); }

  /// The member of a struct that holds the value, whose initialiser is the default.
  /// @param inner the way on, where the member is a struct: `fills(&Rig::camera, &Camera::focal_px)`
  template <class Struct, class Outer, class... Inner>
  Field<Struct> fills(Outer Struct::*outer, Inner... inner) const;
  /// A value that is no plain member: how it is read, and how it is written.
  /// @param write a null node where the key is to be left out; without it, it always is
  template <class Struct>
  Field<Struct> by(std::function<void(const YamlValue&, Struct&)> read,
                   std::function<YAML::Node(const Struct&)> write = {}) const;

  /// The same key with one thing changed.
  template <class Value>
  Key with(Value Key::*what, const std::type_identity_t<Value>& value) const {
    Key key = *this;
    key.*what = value;
    return key;
  }
};

Key number(std::string_view name, const Interval& within, std::string_view says);
Key whole(std::string_view name, int least, int most, std::string_view says);
Key text(std::string_view name, std::string_view says, std::string_view pattern = {});
Key flag(std::string_view name, std::string_view says);
Key choice(std::string_view name, std::vector<std::string_view> names, std::string_view says);
Key group(std::string_view name, const KeyGroup& keys, std::string_view says);

/// The keys that stand together below one key.
struct KeyGroup {
  KeyGroup() = default;
  KeyGroup(const KeyGroup&) = delete;  // keys above refer to it
  KeyGroup& operator=(const KeyGroup&) = delete;
  virtual ~KeyGroup() = default;

  std::string_view kind_key;  ///< the key whose value is the group's kind; empty: there are no kinds
  std::vector<Key> keys;

  /// @return the key, or null when there is none of this name
  const Key* find(std::string_view name) const;
};

/// @return whether groups of a kind have the key; all keys where the kind is not known
bool belongs(const Key& key, std::string_view kind);

/// @return whether groups of a kind need the key (or its alternative)
bool is_needed(const Key& key, std::string_view kind);

/// The declaration of a key.
/// @param path e.g. "camera.gain", "world.balls[3].colour"
/// @return null when there is no such key
const Key* declared_key(const KeyGroup& top, std::string_view path);

}  // namespace stereobench::worlds
