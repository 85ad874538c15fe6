/// What a sweep gave, as a table, as files and as pictures.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/run/run_tally.h"
#include "harness/statistics/statistics.h"
#include "harness/sweep/grid.h"

namespace stereobench::harness {

/// One cell: the run, and detection errors with their spread over the seeds.
struct SweepCell {
  Cell values;
  RunResult result;
  Summary range_rms_m;  ///< over seeds; without values for a sensor without pixels
  Summary bearing_rms_rad;
};

struct SweepResult {
  std::string name;
  std::vector<Variation> variations;
  std::vector<SweepCell> cells;  ///< in the order of grid()
};

/// Puts the seeds of one cell together, one after the other.
class CellTally {
 public:
  /// @param name of the scenario
  CellTally(const std::string& name, const std::string& backend) : run_(name, backend) {}
  void add(const SeedResult& seed);
  const Timing& timing() const { return run_.timing(); }
  /// @throws std::invalid_argument when there is no seed
  SweepCell cell(Cell values) const;

 private:
  RunTally run_;
  std::vector<double> range_rms_m_;  ///< one a seed with pixels
  std::vector<double> bearing_rms_rad_;
};

/// One row a cell: the varied values, detection errors, each filter's mean ATE with its 95 % interval.
std::string sweep_table(const SweepResult& sweep);

/// The content of sweep.csv: one line a cell and filter.
std::string sweep_csv(const SweepResult& sweep);

/// The content of sweep.json: each cell's values with its run.json.
nlohmann::ordered_json sweep_json(const SweepResult& sweep);

/// A picture for a file.
struct NamedPicture {
  std::string file_name;
  std::string png;
};

/// Detection error and ATE against the first variation; one picture for each combination of the others.
std::vector<NamedPicture> sweep_pictures(const SweepResult& sweep);

}  // namespace stereobench::harness
