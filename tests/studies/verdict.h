/// Measurements held against limits, as tables and as JSON.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace stereobench {

/// What a measurement must lie within, ends included; nothing is beyond a limit without ends.
struct Limit {
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
};

/// How a study compares with its limit.
enum class Verdict { kNoLimit, kMet, kShort };

/// One row of a table.
struct Line {
  std::string what;
  double measured = 0.0;    ///< NaN where nothing could be measured, which meets no limit
  double half_width = 0.0;  ///< of the 95 % interval; 0 where there is none
  Limit limit = {};
};

/// Lines that are read together.
struct Section {
  std::string title;
  std::vector<Line> lines;
};

Verdict verdict_of(const Line& line);

/// Whether no line is short of its limit.
bool all_met(const std::vector<Section>& sections);

/// One table below the other: what, measured, limit, verdict.
std::string tables_of(const std::vector<Section>& sections);

/// The content of a study's file; ends that a limit does not have are null.
nlohmann::ordered_json json_of(const std::vector<Section>& sections);

}  // namespace stereobench
