/// What a sweep gave, as a table, as files and as pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/response/response_fit.h"
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
  std::vector<std::vector<double>> ate_m;  ///< one a filter, each with one a seed; NaN where it failed
  std::vector<double> bound_m;             ///< of the position by the filtering bound, one a seed; or empty
};

/// A filter in a cell beside the same filter in the reference cell, on the same seeds.
struct CellDifference {
  std::string filter;
  PairedDifference ate_m;  ///< ATE in the cell minus that in the reference
};

struct SweepResult {
  std::string name;
  std::vector<Variation> variations;
  std::vector<SweepCell> cells;  ///< in the order of grid()
  /// The value of the first variation whose cells the others are compared with; none: they are not.
  std::optional<std::string> paired_to;
  std::optional<ResponseFit> response;  ///< of the errors over the levels of one number; see response_of
};

/// What a cell differs by from the one with the reference value and all else the same, filter by filter;
/// empty where there is no reference.
std::vector<CellDifference> differences_of(const SweepResult& sweep, const SweepCell& cell);

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
  std::vector<std::vector<double>> ate_m_;  ///< one a filter
  std::vector<double> bound_m_;
};

/// One row a cell: the varied values, detection errors, each filter's mean ATE with its 95 % interval; below,
/// the response.
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

/// Detection error and ATE against the first variation, one picture for each combination of the others; and
/// the response, where there is one.
std::vector<NamedPicture> sweep_pictures(const SweepResult& sweep);

}  // namespace stereobench::harness
