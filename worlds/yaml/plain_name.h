/// Names that become names of files and folders.
#pragma once

#include <string>

#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {

/// The pattern of a plain name, for a key's declaration.
inline constexpr std::string_view kPlainNamePattern = "^[A-Za-z0-9_-]+$";

/// A name of letters of ASCII, digits, _ and -.
/// @throws std::runtime_error where the value is none
std::string plain_name(const YamlValue& value);

}  // namespace stereobench::worlds
