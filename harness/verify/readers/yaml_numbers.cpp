#include "harness/verify/readers/yaml_numbers.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/text_file.h"
#include "harness/json/json_line.h"
#include "worlds/yaml/parse_yaml.h"

namespace stereobench::harness {

namespace fs = std::filesystem;

YAML::Node yaml_in(const fs::path& file) {
  return yaml_of(read_text(file), file);
}

YAML::Node yaml_of(const std::string& text, const fs::path& name) {
  try {
    const std::vector<YAML::Node> documents = worlds::parse_yaml(text);
    if (documents.size() == 1 && documents.front().IsMap()) return documents.front();
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(fmt::format("{}: line {}: expected YAML", name.string(), error.mark.line + 1));
  }
  throw std::runtime_error(fmt::format("{}: expected one map in YAML", name.string()));
}

std::vector<double> numbers_in(const fs::path& file, const YAML::Node& map, const std::string& key,
                               std::size_t count) {
  const YAML::Node node = map[key];
  const YAML::Node list = node.IsDefined() && node.IsMap() ? node["data"] : node;
  std::vector<double> numbers;
  if (list.IsDefined() && list.IsSequence())
    for (const YAML::Node& entry : list) {
      double value = 0.0;
      if (entry.IsScalar() && YAML::convert<double>::decode(entry, value) && std::isfinite(value))
        numbers.push_back(value);
    }
  if (numbers.size() != count || list.size() != count)
    throw std::runtime_error(fmt::format("{}: {}: expected {} numbers", file.string(), key, count));
  return numbers;
}

void require_word(const fs::path& file, const YAML::Node& map, const std::string& key,
                  const std::string& word) {
  const YAML::Node node = map[key];
  if (!node.IsDefined() || (node.IsScalar() && node.Scalar() == word)) return;
  throw std::runtime_error(
      fmt::format("{}: {}: expected {}{}", file.string(), key, word,
                  node.IsScalar() ? fmt::format(" (got {})", excerpt(node.Scalar())) : ""));
}

Eigen::Isometry3d transform_in(const fs::path& file, const YAML::Node& map, const std::string& key) {
  constexpr std::size_t kCount = 16;
  const std::vector<double> numbers = numbers_in(file, map, key, kCount);
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < kCount; ++i)
    transform.matrix()(static_cast<int>(i / 4), static_cast<int>(i % 4)) = numbers[i];
  return transform;
}

}  // namespace stereobench::harness
