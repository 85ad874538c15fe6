/// A YAML file with values put in place from outside, and who is to blame for each of its values.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace stereobench::worlds {

struct KeyGroup;

/// One YAML document and where it came from.
struct YamlDocument {
  std::filesystem::path file;
  std::vector<std::string> overridden;  ///< key paths that were put in place of what the file says
  YAML::Node root;
  /// Key paths that something shorter stands for, and the place of that: it is to blame for their values.
  std::map<std::string, std::string> put_by;
};

/// Loads a file of exactly one YAML document and puts "key.path=value" overrides in place; "key[1]=value" is
/// one entry of a list.
///
/// @param keys what the keys are: a list of which an entry is set, and which is left out, has its declared
///   default
/// @throws std::runtime_error when the file is missing, empty or not YAML, or an override is malformed
YamlDocument load_yaml(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const KeyGroup& keys);

/// Whether a key path is that of a value or group, or of something in it: "rig.distortion[0]" lies within
/// "rig".
bool lies_within(const std::string& key, const std::string& group);

/// Where a complaint about a value points to: "file:line: key", "--set key" when an override put it there, or
/// the place of what stands for it, and then the key.
std::string blame(const YamlDocument& document, const std::string& key, const YAML::Mark& mark);

}  // namespace stereobench::worlds
