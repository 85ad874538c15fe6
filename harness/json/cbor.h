/// Values as CBOR: exact to the last bit, with numbers that are not finite.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace nlohmann {

/// Matrices as flat arrays in Eigen's order of storage.
template <int Rows, int Cols>
struct adl_serializer<Eigen::Matrix<double, Rows, Cols>> {
  using Matrix = Eigen::Matrix<double, Rows, Cols>;
  static void to_json(json& j, const Matrix& m) { j = std::vector<double>(m.data(), m.data() + m.size()); }
  static void from_json(const json& j, Matrix& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = j.at(static_cast<std::size_t>(i)).get<double>();
  }
};

template <typename Value>
struct adl_serializer<std::optional<Value>> {
  static void to_json(json& j, const std::optional<Value>& value) {
    j = value ? json(*value) : json(nullptr);
  }
  static void from_json(const json& j, std::optional<Value>& value) {
    value = j.is_null() ? std::nullopt : std::optional<Value>(j.get<Value>());
  }
};

}  // namespace nlohmann

/// How a struct is written as JSON and read: all its members by name. A member that is left out does not
/// compile: it would be lost between processes, without a word.
#define STEREOBENCH_ALL_FIELDS(Type, ...)                                    \
  NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Type, __VA_ARGS__)                      \
  [[maybe_unused]] inline void require_all_fields(const Type& all_of_them) { \
    [[maybe_unused]] const auto& [__VA_ARGS__] = all_of_them;                \
  }

namespace stereobench::harness {

inline std::string bytes_of(const nlohmann::json& json) {
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  return bytes;
}

inline nlohmann::json json_of(std::string_view bytes) {
  return nlohmann::json::from_cbor(bytes.begin(), bytes.end());
}

}  // namespace stereobench::harness
