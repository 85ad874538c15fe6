/// The only place that parses YAML, and the depth to which YAML and JSON files may be nested.
#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace stereobench::worlds {

/// Lists and maps within each other that a YAML or JSON file from outside may have. Our own files have at
/// most seven. Parsers and destructors recurse once a level, and some ten thousand levels exhaust the stack.
inline constexpr int kMostNesting = 64;

/// Parses all documents of a text.
/// @return one node a document
/// @throws YAML::Exception with the place when it is not YAML, is nested more than kMostNesting deep (an
///   alias counts as what it stands for), or an alias lies within what it stands for
std::vector<YAML::Node> parse_yaml(const std::string& text);

}  // namespace stereobench::worlds
