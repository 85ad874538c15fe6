/// Files that are read whole.
#pragma once

#include <filesystem>
#include <string>

namespace stereobench::harness {

/// @throws std::runtime_error, one line, for a file that is missing, a folder, or cannot be read
std::string read_text(const std::filesystem::path& file);

}  // namespace stereobench::harness
