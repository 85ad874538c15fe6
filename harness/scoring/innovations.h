/// Whether what a filter saw was as far from what it expected as it said (NIS).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "harness/statistics/chi_square.h"
#include "harness/statistics/statistics.h"
#include "harness/types.h"

namespace stereobench::harness {

/// The squared lengths of some innovations, summed up. Each has two degrees of freedom and, of a filter that
/// is right, depends on no other: sums over the time of a run are chi-square, unlike those of its errors.
struct InnovationSum {
  SquaredSum all;
  SquaredSum used;  ///< without those of sightings that the filter refused

  long sightings() const { return all.degrees_of_freedom / 2; }
  long refused() const { return (all.degrees_of_freedom - used.degrees_of_freedom) / 2; }
  void add(const slam::NormalisedInnovation& innovation);
  InnovationSum& operator+=(const InnovationSum& other);
};

/// One run's.
struct InnovationScore {
  InnovationSum run;
  std::map<int, InnovationSum> by_landmark;  ///< by landmark_id; sightings that are nobody's are left out
};

InnovationScore score_innovations(const FilterRun& run, const MeasurementLog& log);

/// A landmark and how probable it is that chance alone takes its sum as far out, among so many landmarks.
struct LandmarkInnovations {
  int landmark_id = slam::kUnknown;
  InnovationSum sum;
  double p = 1.0;  ///< after Holm
};

/// All seeds'.
struct InnovationSummary {
  Summary nis;       ///< over seeds: a run's sum over its degrees of freedom; 1 is consistent
  Summary nis_used;  ///< without the refused
  InnovationSum sum;
  long runs_outside = 0;       ///< of their 99 % band, Holm-corrected for the number of runs
  std::vector<double> run_ps;  ///< one a run, after Holm
  long landmarks = 0;          ///< that were seen again
  long landmarks_outside = 0;  ///< of their 99 % band over all seeds, Holm-corrected for their number
  std::optional<LandmarkInnovations> worst;  ///< the least probable; the longest of those as improbable
};

/// Adds runs up, seed by seed. It keeps one sum a run and one a landmark.
class InnovationTally {
 public:
  void add(const InnovationScore& score);
  InnovationSummary summary(Seeds seeds = Seeds::kWorlds) const;

 private:
  std::vector<InnovationSum> runs_;
  std::map<int, InnovationSum> by_landmark_;
};

}  // namespace stereobench::harness
