/// Suites: scenarios that are run one after the other and held against a baseline, read from strict YAML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/types.h"
#include "harness/regression/metric_rule.h"

namespace stereobench::harness {

/// Which pictures of a case are kept in its baseline, and how far later ones may be off.
struct GoldenWish {
  std::vector<int> frames;  ///< steps of the drive, of the first seed
  std::string limits = "exact";
};

/// One scenario of a suite, with what is changed of it. Empty values: as the scenario says.
struct SuiteCase {
  std::string name;
  std::filesystem::path scenario;
  std::vector<std::string> set;  ///< "key.path=value"
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> filters;
  int particles = 0;
  std::string detector;  ///< command of a program, or a linked detector's name
  double detector_timeout_s = 0.0;
  std::optional<double> detector_start_s;
  std::vector<Gate> gates;           ///< beside those of the scenario
  std::vector<Margin> margins;       ///< the last one that fits counts
  std::vector<std::string> metrics;  ///< patterns of the metrics that are judged; empty: all
  GoldenWish golden;
};

struct Suite {
  std::filesystem::path file;
  std::string name;
  double alpha = 0.01;  ///< chance of any false alarm, all cases together
  std::vector<SuiteCase> cases;
};

/// Reads a suite. Lists of a preset come before those of the case that is like it; other keys of the case
/// take the place of the preset's.
/// @param file the YAML file; scenarios in it are relative to its folder
/// @throws std::runtime_error of one line, "file:line: key: expected ... (got ...)"; of a line for each
/// unknown or missing key
Suite read_suite(const std::filesystem::path& file);

/// Where a suite's baseline lies unless somebody says otherwise: NAME.baseline beside NAME.yaml.
std::filesystem::path usual_baseline(const std::filesystem::path& suite);

}  // namespace stereobench::harness
