/// Numbers of other people's YAML files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// The one document of a file.
/// @throws std::runtime_error "file: ...", where it is no map in YAML
YAML::Node yaml_in(const std::filesystem::path& file);

/// The same of a text. @param name what it is called in errors
YAML::Node yaml_of(const std::string& text, const std::filesystem::path& name);

/// A list of numbers; a matrix of OpenCV or of ASL is the list in its `data`.
/// @throws std::runtime_error "file: key: expected 4 numbers"
std::vector<double> numbers_in(const std::filesystem::path& file, const YAML::Node& map,
                               const std::string& key, std::size_t count);

/// Makes sure that a key has a value, where the file has the key: the model of a camera or of its lens.
/// @throws std::runtime_error "file: key: expected pinhole (got omni)"
void require_word(const std::filesystem::path& file, const YAML::Node& map, const std::string& key,
                  const std::string& word);

/// Sixteen numbers, row by row, as a transform.
Eigen::Isometry3d transform_in(const std::filesystem::path& file, const YAML::Node& map,
                               const std::string& key);

}  // namespace stereobench::harness
