/// Tables of keys that are bound to the members of a struct, for example
///
///     const Fields<Light>& light_keys() {
///       static const Fields<Light> keys({
///           number("ambient", {0.0, 1.0}, "Light that comes from everywhere.").fills(&Light::ambient),
///           number("elevation_deg", {0.0, 90.0}, "How high it stands, in degrees.")
///               .times(kRadPerDegree)
///               .fills(&Light::elevation_rad),
///       });
///       return keys;
///     }
///
/// `light_keys().read(value)` reads such a group and `.write(light)` writes it; ranges, names, units and
/// defaults stand nowhere else.
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "worlds/yaml/field_values.h"

namespace stereobench::worlds {

/// A key, and the member of a struct that it fills.
template <class Struct>
struct Field {
  Field(Key declared) : key(std::move(declared)) {}  // one that is read by hand
  /// The same field, read in a way of its own.
  Field reading(std::function<void(const YamlValue&, Struct&)> reader) const {
    Field field = *this;
    field.read = std::move(reader);
    return field;
  }

  Key key;
  std::function<void(const YamlValue&, Struct&)> read;
  std::function<YAML::Node(const Struct&)> write;  ///< a null node: the key is left out
};

/// The keys that stand together below one key, and the struct that they fill.
template <class Struct>
class Fields : public KeyGroup {
 public:
  /// What must be so of all keys together, once each of them is read.
  using Check = std::function<void(const YamlMap&, Struct&)>;

  explicit Fields(std::vector<Field<Struct>> fields, Check check = {})
      : fields_(std::move(fields)), check_(std::move(check)) {
    for (const Field<Struct>& field : fields_) keys.push_back(field.key);
  }
  /// @param kind the key whose value is the group's kind
  Fields(std::string_view kind, std::vector<Field<Struct>> fields, Check check = {})
      : Fields(std::move(fields), std::move(check)) {
    kind_key = kind;
  }

  const std::vector<Field<Struct>>& fields() const { return fields_; }

  /// Fills the members whose keys are written; the others stay as they are.
  /// @throws std::runtime_error where a value is not what its key declares
  void read_into(const YamlValue& value, Struct& object) const {
    const YamlMap map(value, *this);
    for (const Field<Struct>& field : fields_)
      if (field.read)
        if (const auto found = map.find(field.key.name)) field.read(*found, object);
    if (check_) check_(map, object);
  }

  Struct read(const YamlValue& value) const {
    Struct object;
    read_into(value, object);
    return object;
  }

  /// Puts keys into a group that may be there already.
  /// @param names which; none: all
  void write_into(YAML::Node group, const Struct& object,
                  const std::vector<std::string_view>& names = {}) const {
    for (const Field<Struct>& field : fields_) {
      const bool is_asked = names.empty() || std::ranges::find(names, field.key.name) != names.end();
      if (!is_asked || !field.write) continue;
      if (const YAML::Node value = field.write(object); !value.IsNull())
        group[std::string(field.key.name)] = value;
    }
  }

  /// The group on one line.
  YAML::Node write(const Struct& object) const {
    YAML::Node group(YAML::NodeType::Map);
    write_into(group, object);
    group.SetStyle(YAML::EmitterStyle::Flow);
    return group;
  }

 private:
  std::vector<Field<Struct>> fields_;
  Check check_;
};

/// A struct of its own below a key, whose table was declared with it.
template <class Struct>
requires std::is_class_v<Struct>
void read_value(const YamlValue& value, const Key& key, Struct& object) {
  dynamic_cast<const Fields<Struct>&>(*key.group).read_into(value, object);
}

template <class Struct>
requires std::is_class_v<Struct> YAML::Node written(const Key& key, const Struct& object) {
  return dynamic_cast<const Fields<Struct>&>(*key.group).write(object);
}

/// Gives a field the default that the struct's initialiser says, where it is a constant.
template <class Struct>
Field<Struct> with_default(Field<Struct> field) {
  const Key& key = field.key;
  const bool always_needed = key.required || (!key.required_for.empty() && key.required_for == key.kinds);
  const bool is_constant = !always_needed && key.fallback_says.empty() && key.same_as.empty();
  if (is_constant && key.kind != ValueKind::kGroup && field.write)
    field.key.fallback = one_line(field.write(Struct()));
  if (!key.omits_default) return field;
  field.write = [write = field.write, usual = key.fallback](const Struct& object) {
    const YAML::Node value = write(object);
    return one_line(value) == usual ? YAML::Node() : value;
  };
  return field;
}

template <class Struct>
Field<Struct> Key::by(std::function<void(const YamlValue&, Struct&)> read,
                      std::function<YAML::Node(const Struct&)> write) const {
  Field<Struct> field(*this);
  field.read = std::move(read);
  field.write = std::move(write);
  return with_default(std::move(field));
}

template <class Struct, class Outer, class... Inner>
Field<Struct> Key::fills(Outer Struct::*outer, Inner... inner) const {
  const auto member = [=](auto& object) -> auto& {
    return ((object.*outer).*....*inner);
  };
  using Member = std::remove_cvref_t<decltype(member(std::declval<Struct&>()))>;
  Key key = *this;
  if (key.lengths.most == 0 && kListLength<Member> != 0)
    key = kOneForAll<Member> ? key.or_vector(kListLength<Member>) : key.vector(kListLength<Member>);
  return key.by<Struct>(
      [=](const YamlValue& value, Struct& object) { read_value(value, key, member(object)); },
      [=](const Struct& object) { return written(key, member(object)); });
}

/// The fields of several groups, one after the other.
template <class Struct>
std::vector<Field<Struct>> joined(const std::vector<std::vector<Field<Struct>>>& groups) {
  std::vector<Field<Struct>> fields;
  for (const std::vector<Field<Struct>>& group : groups)
    fields.insert(fields.end(), group.begin(), group.end());
  return fields;
}

/// Puts fields into a list, behind the one with this name, which must be there.
template <class Struct>
void insert_behind(std::string_view name, const std::vector<Field<Struct>>& more,
                   std::vector<Field<Struct>>& fields) {
  const auto has_name = [name](const Field<Struct>& field) { return field.key.name == name; };
  const auto found = std::ranges::find_if(fields, has_name);
  if (found == fields.end()) throw std::logic_error("insert_behind: no key " + std::string(name));
  fields.insert(found + 1, more.begin(), more.end());
}

/// The fields of a member, as fields of the struct that has it. What is read or written by hand stays so.
template <class Outer, class Inner>
std::vector<Field<Outer>> lifted(Inner Outer::*member, const std::vector<Field<Inner>>& fields) {
  std::vector<Field<Outer>> outer;
  for (const Field<Inner>& field : fields) {
    Field<Outer> whole(field.key);
    if (field.read)
      whole.read = [read = field.read, member](const YamlValue& value, Outer& object) {
        read(value, object.*member);
      };
    if (field.write)
      whole.write = [write = field.write, member](const Outer& object) { return write(object.*member); };
    outer.push_back(with_default(std::move(whole)));
  }
  return outer;
}

}  // namespace stereobench::worlds
