/// Command lines to copy.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stereobench::harness {

/// A word as a POSIX shell reads it back: in quotes where it needs them.
std::string shell_word(std::string_view word);

/// Words in one line, each as shell_word.
std::string shell_line(std::span<const std::string> words);

/// Seeds as --seeds reads them: "0..9", "3" or "0,4,7".
std::string seeds_word(std::span<const std::uint64_t> seeds);

}  // namespace stereobench::harness
