#include "harness/io/text_file.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {

std::string read_text(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw std::runtime_error(fmt::format("{}: no such file", file.string()));
  if (std::filesystem::is_directory(file))
    throw std::runtime_error(fmt::format("{}: expected a file (got a folder)", file.string()));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return content.str();
}

}  // namespace stereobench::harness
