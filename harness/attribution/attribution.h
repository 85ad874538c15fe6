/// What a study of whose an error is gave: numbers over the seeds, as a table and as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/attribution/oracles.h"
#include "harness/run/seed_metrics.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {

/// What a part is worth over the seeds, see PartWorth.
struct PartSummary {
  std::string part;
  Summary share;
  Summary only_perfect;
  Summary only_real;
};

/// A metric of a filter, and whose it is.
struct AttributedMetric {
  std::string filter;
  std::string metric;  ///< e.g. "ate_rms_m"
  std::string unit;    ///< "m"; empty for a number without unit
  Summary real;        ///< nothing is perfect
  Summary perfect;     ///< everything is
  std::vector<PartSummary> parts;
  std::size_t seeds_left_out = 0;  ///< that lack a value in some coalition
};

struct Attribution {
  std::string scenario;
  std::vector<std::uint64_t> seeds;
  std::vector<Oracle> parts;  ///< with the estimator, which comes last
  std::vector<AttributedMetric> metrics;
};

/// The coalitions of parts that are driven: all sets of them, the estimator aside, in order of their bits.
/// @return the lines of the scenario for each
std::vector<std::vector<std::string>> coalition_lines(const std::vector<Oracle>& oracles);

/// Shares ATE, map error and ANEES of each filter among the parts, dead reckoning aside.
///
/// The Cramer-Rao bound knows of noise alone. So what a filter adds to it is taken where all noise is real
/// and the other parts are perfect: there a perfect estimator keeps the share bound^2 / error^2 of the
/// squares, summed over the seeds (of the ANEES 1 / ANEES). Everywhere it takes the rest of that share off
/// the squares of the noise that there is: error^2 - (1 - share) unbiased^2, not below 0. Without a bound the
/// estimator is no part. Seeds that lack a value in any coalition are left out of all.
/// @param oracles those of coalition_lines, without the estimator
/// @param metrics one a coalition, in the same order
Attribution attribution_of(const std::string& scenario, const std::vector<std::uint64_t>& seeds,
                           const std::vector<Oracle>& oracles, const std::vector<std::string>& filters,
                           const std::vector<SeedMetrics>& metrics);

/// "1 seed", "10 seeds".
std::string seeds_in_words(std::size_t seeds);

/// A table a filter and metric. Filters that have no such metric are left out.
std::string attribution_table(const Attribution& attribution);

/// The content of attribution.json.
nlohmann::ordered_json attribution_json(const Attribution& attribution);

}  // namespace stereobench::harness
