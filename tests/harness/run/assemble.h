/// Drives scored and put together, as commands do with those of their workers.
#pragma once

#include <string>
#include <vector>

#include "harness/run/run_tally.h"
#include "harness/run/seed_result.h"

namespace stereobench::harness {

inline RunResult assemble(const std::string& name, const std::string& backend,
                          const std::vector<SeedDrive>& drives) {
  RunTally tally(name, backend);
  for (const SeedDrive& drive : drives) tally.add(score_seed(drive, {}));
  return tally.result();
}

inline std::string steps_csv(const std::vector<SeedDrive>& drives) {
  std::string csv = steps_csv_header();
  for (const SeedDrive& drive : drives) csv += score_seed(drive, {.steps = true}).csv;
  return csv;
}

}  // namespace stereobench::harness
