/// Files of JSON, read strictly.
#pragma once

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {

/// Reads a file with a function of its value.
/// @param read takes a JsonValue, which lives as long as the call
/// @return what `read` returns
/// @throws std::runtime_error "file: key: what was expected", and as read_text and `read`
template <class Read>
auto read_json_file(const std::filesystem::path& file, const Read& read) {
  const std::string text = read_text(file);
  try {
    const nlohmann::json json = parse_line(text);
    return read(JsonValue(json, ""));
  } catch (const BadLine& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace stereobench::harness
