/// What a case of a suite gave when somebody said that it was good: text in version control.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/regression/detected_balls.h"
#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// Who said so, and of what.
struct Blessing {
  std::string reason;
  std::string version;     ///< of stereobench
  std::string instead_of;  ///< SHA-256 of the baseline that it took the place of; empty for the first one
};

/// Where the numbers are from: equal inputs are needed for a comparison, pixels for pictures.
struct BaselineInputs {
  std::string sha256;    ///< of the scenario, what was changed of it, and its files
  std::string pixels;    ///< the renderer's fingerprint; empty without pictures
  std::string detector;  ///< who looked; others may be compared with it
};

struct Baseline {
  std::string scenario;  ///< its name
  BaselineInputs inputs;
  Blessing blessing;
  SeedTable seeds;
};

/// The files of a case in a baseline's folder.
std::filesystem::path baseline_file(const std::filesystem::path& folder, const std::string& name);
std::filesystem::path findings_file(const std::filesystem::path& folder, const std::string& name);

/// Its lines: keys and metrics in a fixed order, the values of a metric on one line.
std::string baseline_text(const Baseline& baseline);

/// @return empty where there is no such file
/// @throws std::runtime_error "file: key: what was expected"
std::optional<Baseline> read_baseline(const std::filesystem::path& file);

}  // namespace stereobench::harness
