/// What somebody may have meant who misspelt a word.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stereobench::worlds {

/// The known word that takes the fewest changes, of at most half its letters: one letter inserted, dropped,
/// changed or swapped with its neighbour is a change.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string_view> known);

/// @param known at least one
/// @return "did you mean x?" where there is a nearest word, else "expected one of ..." with all of them
std::string advice(std::string_view word, std::span<const std::string_view> known);

}  // namespace stereobench::worlds
