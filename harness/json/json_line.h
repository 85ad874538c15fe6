/// Lines of JSON that others write, read strictly: whatever is not exactly what is expected is an error that
/// says where, what was expected, and what is there.
#pragma once

#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {

using worlds::excerpt;

/// The least number where one must be positive.
inline constexpr double kLeastPositive = 1e-9;

/// What is wrong with a line, e.g. "balls[2].range_m: expected a number from 0 to 1e+06 (got -1)".
class BadLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value of a line, and where it stands in it. It refers to the value, which must outlive it.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

  /// The finite number between two bounds, both included.
  double number(double least, double most) const;
  /// The whole number between two bounds, both included.
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  /// Any whole number that is not negative, e.g. a seed.
  std::uint64_t natural_number() const;
  std::string text() const;
  bool flag() const;
  bool is_null() const { return value_->is_null(); }
  bool is_text() const { return value_->is_string(); }
  /// The entries of a list that has between `least` and `most` of them.
  std::vector<JsonValue> list(std::size_t least, std::size_t most) const;
  /// The keys of an object and their values.
  std::vector<std::pair<std::string, JsonValue>> entries() const;
  /// Checks that it is an object whose keys are all known.
  void allow(std::initializer_list<std::string_view> keys) const;
  /// The value of a key; empty where there is none.
  std::optional<JsonValue> find(std::string_view key) const;
  /// The value of a key that must be there.
  JsonValue at(std::string_view key) const;

  /// Ends the reading: what was expected here.
  [[noreturn]] void refuse(std::string_view expectation) const;

 private:
  const nlohmann::json* value_;
  std::string place_;  ///< e.g. "balls[2].range_m"; empty for the whole line
};

/// Reads a line of JSON; the only place that parses JSON.
/// @throws BadLine when it is none, or nested more than worlds::kMostNesting deep
nlohmann::json parse_line(const std::string& line);

}  // namespace stereobench::harness
