#include "harness/page/command_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stereobench::harness {

std::string shell_word(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::string seeds_word(std::span<const std::uint64_t> seeds) {
  const bool in_a_row = seeds.size() > 1 && std::ranges::adjacent_find(seeds, [](auto a, auto b) {
                                              return b != a + 1;
                                            }) == seeds.end();
  return in_a_row ? fmt::format("{}..{}", seeds.front(), seeds.back())
                  : fmt::format("{}", fmt::join(seeds, ","));
}

}  // namespace stereobench::harness
