/// The hidden command that completions of shells call: `stereobench complete -- WORDS...`.
#pragma once

#include <span>
#include <string>

#include <CLI/CLI.hpp>

namespace stereobench::harness {

/// Prints what may stand in place of the last word, a line each: the word, a blank where it is whole, a tab,
/// and what it is.
/// @param program with all of its commands
/// @param words behind `complete`
/// @return the exit code
/// @throws std::runtime_error where they do not begin with "--"
int complete(const CLI::App& program, std::span<const std::string> words);

}  // namespace stereobench::harness
