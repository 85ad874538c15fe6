/// How a command line may go on, for shells: made of the program's own options and tables, so that nothing is
/// listed twice.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/completion/candidate.h"

namespace stereobench::harness {

/// What may stand in place of the last word of a command line.
///
/// @param program with all of its commands; those of no group are hidden
/// @param words those behind the program's name, as the shell hands them on; the last one is being written,
///   and may be empty
/// @return words that begin with the last one; none where only the user knows, or where it is a file's name
std::vector<Candidate> candidates(const CLI::App& program, std::span<const std::string> words);

}  // namespace stereobench::harness
