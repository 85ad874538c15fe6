/// The built program, run as a user runs it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/test_folder.h"

namespace stereobench::harness {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal when a signal ended it
  std::string out;
  std::string err;
};

/// Variables that a program is given beside those it inherits: "NAME=value".
using Environment = std::vector<std::string>;

/// Arguments, and more behind them.
inline std::vector<std::string> with(std::vector<std::string> arguments,
                                     const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Runs `stereobench` with arguments and waits for it; its output is not a terminal.
Outcome run_stereobench(const std::vector<std::string>& arguments, Environment environment = {});

/// The path of a shipped scenario.
std::string scenario_path(const std::string& name);

/// All of a file's bytes. Fails the test when it cannot be read.
std::string bytes_of(const std::filesystem::path& path);

}  // namespace stereobench::harness
