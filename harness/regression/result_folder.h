/// Results that a run left behind, read back.
#pragma once

#include <filesystem>
#include <string>

#include "harness/json/json_line.h"
#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// What is compared of a result.
struct StoredResult {
  std::string scenario;  ///< its name
  SeedTable seeds;
  std::filesystem::path detections;  ///< its detections.csv.gz; empty where there is none
};

/// The seeds and their metrics in a run.json, or in what has its keys.
/// @throws BadLine where they are not as `run` writes them
SeedTable seed_table_of(const JsonValue& run);

/// Reads the metrics of each seed from a result.
/// @param path a folder that `run` or `slam` wrote, or its run.json
/// @throws std::runtime_error "file: key: what was expected" for a run.json that is not as they write it, and
/// for a folder without one: its run did not end
StoredResult read_result(const std::filesystem::path& path);

}  // namespace stereobench::harness
