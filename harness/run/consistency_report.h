/// What run.json, steps.csv and the table say of whether filters know how wrong they are.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "harness/run/run_result.h"

namespace stereobench::harness {

/// The "consistency" of a filter in run.json.
nlohmann::ordered_json consistency_json(const FilterResult& filter);

/// The header of the columns that consistency_cells fills.
std::string consistency_columns();

/// One step's cells in steps.csv, each with a comma before it.
std::string consistency_cells(const FilterRun& run, const FilterScore& score, const LogStep& step,
                              std::size_t k);

/// One line a filter.
std::string consistency_table(const RunResult& result);

}  // namespace stereobench::harness
