/// What options take, from the tables that also read them.
#pragma once

#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/completion/candidate.h"

namespace stereobench::harness {

/// An option whose values are known.
struct ValueSource {
  std::string_view command;  ///< empty: every command that has the option
  std::string_view option;   ///< "--filters", or the name of a positional argument
  /// @param word as it is written so far, e.g. "camera.gain=1" or "ekf,uf"
  std::vector<Candidate> (*find)(std::string_view word);
};

/// All of them.
std::vector<ValueSource> value_sources();

/// What an option of a command may be given: of value_sources(), or the words that it checks for itself.
std::vector<Candidate> values_of(const CLI::App& command, const CLI::Option& option, std::string_view word);

}  // namespace stereobench::harness
