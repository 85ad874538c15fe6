/// Values of a strict YAML document: each knows where it stands and can say what was expected of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "worlds/yaml/key_group.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::worlds {

/// One value of a document. It refers to the document, which must outlive it.
class YamlValue {
 public:
  /// @param key the full path of the value, e.g. "world.balls[3].colour"
  /// @param mark where complaints about it point to: its key, or itself in a list
  YamlValue(const YamlDocument& document, std::string key, YAML::Node node, YAML::Mark mark);

  /// A finite number within bounds; quoted text is no number.
  double number(const Interval& within) const;
  /// A whole number within bounds.
  int integer(int least, int most) const;
  /// Text that is not empty.
  std::string text() const;
  /// The folder of the document.
  std::filesystem::path folder() const { return document_->file.parent_path(); }
  /// The file or folder that text names, relative to the document's folder: absolute.
  std::filesystem::path path() const;
  /// `true` or `false`.
  bool flag() const;
  /// The index of the one of `names` that is written here.
  std::size_t choice(std::span<const std::string_view> names) const;
  /// Whether a list is written here.
  bool is_list() const { return node_.IsSequence(); }
  /// Whether a group of keys is written here.
  bool is_group() const { return node_.IsMap(); }
  /// The plain text of a single value; empty for lists and groups.
  std::string scalar() const { return node_.IsScalar() ? node_.Scalar() : std::string(); }
  /// The entries of a list that has between `least` and `most` of them.
  std::vector<YamlValue> list(std::size_t least, std::size_t most) const;

  /// How many entries a list has.
  std::size_t size() const { return node_.size(); }
  /// A key of this group that is not written: complaints about it point to the group.
  YamlValue at_key(std::string_view key) const;

  /// Where the value stands: file, line, key.
  std::string place() const;

  /// Throws a std::runtime_error: where the value stands, what was expected, what is there.
  [[noreturn]] void fail(std::string_view expected) const;
  /// Throws a std::runtime_error: where the value stands and what is wrong with it as a whole.
  [[noreturn]] void refuse(std::string_view reason) const;

 private:
  friend class YamlMap;
  const YamlDocument* document_;
  std::string key_;
  YAML::Node node_;
  YAML::Mark mark_;
};

/// A group of keys.
///
/// `check_keys` has made sure that no key is unknown, repeated or missing. Asking for a key that is not
/// declared throws a std::logic_error.
class YamlMap {
 public:
  YamlMap(const YamlValue& value, const KeyGroup& group);

  /// The group itself.
  const YamlValue& value() const { return value_; }
  /// All keys that are written, in their order.
  std::vector<std::pair<std::string, YamlValue>> entries() const;

  /// The value of a key that may be left out.
  std::optional<YamlValue> find(std::string_view key) const;
  /// The value of a key that must be there.
  YamlValue at(std::string_view key) const;

 private:
  YamlValue value_;
  const KeyGroup* group_;
};

/// Makes sure that each key is known, is written once, and that none is missing, here and below.
/// @throws std::runtime_error with a line for every key that is not so
void check_keys(const YamlValue& value, const KeyGroup& group);

}  // namespace stereobench::worlds
