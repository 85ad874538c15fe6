/// Values of a strict YAML document: each knows where it stands and can say what was expected of it.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/yaml_document.h"

namespace stereobench::worlds {

/// The finite numbers between two bounds, both included.
struct Interval {
  double least = 0.0;
  double most = 0.0;
};

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
  /// `true` or `false`.
  bool flag() const;
  /// The index of the one of `names` that is written here.
  std::size_t choice(std::span<const std::string_view> names) const;
  /// Whether a list is written here.
  bool is_list() const { return node_.IsSequence(); }
  /// The entries of a list that has between `least` and `most` of them.
  std::vector<YamlValue> list(std::size_t least, std::size_t most) const;

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

/// A group of keys. Making one checks that each key is known and written once.
class YamlMap {
 public:
  YamlMap(const YamlValue& value, std::span<const std::string_view> known);
  YamlMap(const YamlValue& value, std::initializer_list<std::string_view> known)
      : YamlMap(value, std::span(known.begin(), known.size())) {}

  /// The value of a key that may be left out.
  std::optional<YamlValue> find(std::string_view key) const;
  /// The value of a key that must be there.
  YamlValue at(std::string_view key) const;
  /// A number within bounds: required, or `fallback` when the key is left out.
  double number(std::string_view key, const Interval& within, std::optional<double> fallback = {}) const;

 private:
  YamlValue value_;
};

}  // namespace stereobench::worlds
