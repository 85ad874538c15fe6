/// How the types that members of a struct have are read and written.
///
/// A type is bound to keys by two functions: `read_value`, and `written`, which also gives the words of a
/// default. Both are found by the type's namespace, so a type may bring its own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {

/// @throws std::runtime_error where the value is not what the key declares
void read_value(const YamlValue& value, const Key& key, double& number);
void read_value(const YamlValue& value, const Key& key, int& number);
void read_value(const YamlValue& value, const Key& key, std::uint64_t& number);
void read_value(const YamlValue& value, const Key& key, bool& flag);
void read_value(const YamlValue& value, const Key& key, std::string& text);

YAML::Node written(const Key& key, double number);
YAML::Node written(const Key& key, int number);
YAML::Node written(const Key& key, std::uint64_t number);
YAML::Node written(const Key& key, bool flag);
YAML::Node written(const Key& key, const std::string& text);

/// A list of the entries on one line.
YAML::Node flow_list(const std::vector<YAML::Node>& entries);

/// A written value on one line, as people are told of a default.
std::string one_line(const YAML::Node& node);

template <class Choice>
requires std::is_enum_v<Choice>
void read_value(const YamlValue& value, const Key& key, Choice& choice) {
  choice = static_cast<Choice>(key.first + static_cast<int>(value.choice(key.names)));
}

template <class Choice>
requires std::is_enum_v<Choice> YAML::Node written(const Key& key, Choice choice) {
  const int place = static_cast<int>(choice) - key.first;
  const bool has_name = place >= 0 && place < static_cast<int>(key.names.size());
  return has_name ? YAML::Node(std::string(key.names[static_cast<std::size_t>(place)])) : YAML::Node();
}

/// A list of exactly N numbers, or one that stands for all where the key allows it.
template <int N>
void read_value(const YamlValue& value, const Key& key, Eigen::Matrix<double, N, 1>& vector) {
  double number = 0.0;
  if (key.lengths.single && !value.is_list()) {
    read_value(value, key, number);
    vector.setConstant(number);
    return;
  }
  const std::vector<YamlValue> entries = value.list(N, N);
  for (int i = 0; i < N; ++i) read_value(entries[static_cast<std::size_t>(i)], key, vector[i]);
}

template <int N>
YAML::Node written(const Key& key, const Eigen::Matrix<double, N, 1>& vector) {
  std::vector<YAML::Node> entries;
  for (int i = 0; i < N; ++i) entries.push_back(written(key, vector[i]));
  return flow_list(entries);
}

template <class Value>
void read_value(const YamlValue& value, const Key& key, std::optional<Value>& optional) {
  read_value(value, key, optional.emplace());
}

template <class Value>
YAML::Node written(const Key& key, const std::optional<Value>& optional) {
  return optional ? written(key, *optional) : YAML::Node();
}

template <class Value>
void read_value(const YamlValue& value, const Key& key, std::vector<Value>& values) {
  values.clear();
  for (const YamlValue& entry : value.list(key.lengths.least, key.lengths.most))
    read_value(entry, key, values.emplace_back());
}

template <class Value>
YAML::Node written(const Key& key, const std::vector<Value>& values) {
  std::vector<YAML::Node> entries;
  for (const Value& value : values) entries.push_back(written(key, value));
  return flow_list(entries);
}

/// How many numbers a type takes: those of a vector are written as a list.
template <class Value>
inline constexpr std::size_t kListLength = 0;
template <int N>
inline constexpr std::size_t kListLength<Eigen::Matrix<double, N, 1>> = N;
template <class Value>
inline constexpr std::size_t kListLength<std::optional<Value>> = kListLength<Value>;
/// Whether one number may stand for all of them.
template <class Value>
inline constexpr bool kOneForAll = false;

}  // namespace stereobench::worlds
