/// What the studies' programs have in common: options, exit codes, and what is said of the measurements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tests/studies/verdict.h"

namespace stereobench {

/// What each study is asked for.
struct StudyArguments {
  std::string seeds;
  int jobs = 2;
  std::filesystem::path out;
};

/// Adds `--seeds`, `--jobs` and `--out`.
/// @param seeds_are what the help says of `--seeds`, whose default the arguments have
void add_study_options(CLI::App& program, StudyArguments& arguments, const std::string& seeds_are);

/// What a program's footer says of its exit codes.
inline constexpr const char* kStudyExitCodes =
    "Exit codes: 0 all limits are met, 1 one is short, 2 bad usage, 4 a process crashed.\n\n";

/// The seeds that are asked for, once the folder of `--out` is there.
/// @throws std::runtime_error when they are no seeds, or there can be no such folder
std::vector<std::uint64_t> seeds_of(const StudyArguments& arguments);

/// Prints the tables, and writes them to `--out`.
/// @param facts what stands before the sections in the file
/// @return the exit code
int conclude(const StudyArguments& arguments, nlohmann::ordered_json facts,
             const std::vector<Section>& sections);

/// Parses a command line and does the study; complaints go to standard error.
/// @return the exit code
int run_study(CLI::App& program, int argc, char** argv, const std::function<int()>& study);

}  // namespace stereobench
