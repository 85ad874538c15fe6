/// What every entry promises, and how it is checked.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

#include "tests/fuzz/entries.h"

namespace stereobench::fuzz {

/// Ends the program where a promise is broken.
inline void expect(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// Runs a reader; an error of a line is fine, or of one for each of the first wrong keys.
template <typename Reader>
void read_or_complain(const Reader& read, std::ptrdiff_t most_lines = 21) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    const std::string_view text = error.what();
    const std::ptrdiff_t lines = 1 + std::count(text.begin(), text.end(), '\n');
    expect(!text.empty() && lines <= most_lines, "an error is a line, or one a wrong key");
    expect(text.size() < static_cast<std::size_t>(lines) * 4096, "an error is not long");
  }
}

inline std::string text_of(Bytes bytes) {
  return {bytes.begin(), bytes.end()};
}

/// A file or folder of this process's own.
inline std::filesystem::path own_file(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         ("stereobench_fuzz." + std::to_string(getpid()) + "." + name);
}

}  // namespace stereobench::fuzz
