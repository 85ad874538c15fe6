#include "harness/trajectories/pairing.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/types.h"

namespace stereobench::harness {
namespace {

/// @param stamps_ns rising, at least one
/// @return the index of the one that is nearest; the earlier of two
std::size_t nearest(const std::vector<std::int64_t>& stamps_ns, std::int64_t stamp_ns) {
  const auto next = std::ranges::lower_bound(stamps_ns, stamp_ns);
  const auto at = static_cast<std::size_t>(next - stamps_ns.begin());
  if (next == stamps_ns.end()) return at - 1;
  if (at == 0) return 0;
  return stamp_ns - stamps_ns[at - 1] <= *next - stamp_ns ? at - 1 : at;
}

TrajectoryPairs pair_by_number(const Trajectory& estimate, const Trajectory& truth, double offset_s) {
  if (offset_s != 0.0) throw std::runtime_error("--offset-s: a file has no times that it could be added to");
  if (estimate.poses.size() != truth.poses.size())
    throw std::runtime_error(fmt::format(
        "the estimate has {} poses and the truth {}: without times in both files they must be as many",
        estimate.poses.size(), truth.poses.size()));
  return {.estimate = estimate.poses, .truth = truth.poses};
}

TrajectoryPairs pair_by_time(const Trajectory& estimate, const Trajectory& truth, const PairingRules& rules) {
  TrajectoryPairs pairs;
  const std::int64_t offset_ns = std::llround(rules.offset_s * static_cast<double>(kSecond_ns));
  const double most_ns = rules.most_dt_s * static_cast<double>(kSecond_ns);
  const bool truth_is_longer = truth.poses.size() >= estimate.poses.size();
  const Trajectory& shorter = truth_is_longer ? estimate : truth;
  const Trajectory& longer = truth_is_longer ? truth : estimate;
  const std::int64_t shift_ns = truth_is_longer ? offset_ns : -offset_ns;
  std::size_t before = longer.poses.size();
  for (std::size_t i = 0; i < shorter.poses.size(); ++i) {
    const std::int64_t stamp_ns = shorter.stamps_ns[i] + shift_ns;
    const std::size_t j = nearest(longer.stamps_ns, stamp_ns);
    if (static_cast<double>(std::abs(longer.stamps_ns[j] - stamp_ns)) > most_ns) continue;
    pairs.estimate.push_back(estimate.poses[truth_is_longer ? i : j]);
    pairs.truth.push_back(truth.poses[truth_is_longer ? j : i]);
    pairs.stamps_ns.push_back(truth.stamps_ns[truth_is_longer ? j : i]);
    pairs.repeated += j == before ? 1 : 0;
    before = j;
  }
  if (pairs.truth.empty())
    throw std::runtime_error(fmt::format(
        "no two times of estimate and truth lie within {} s: expected the same clock; --offset-s shifts one",
        rules.most_dt_s));
  return pairs;
}

}  // namespace

TrajectoryPairs pair_trajectories(const Trajectory& estimate, const Trajectory& truth,
                                  const PairingRules& rules) {
  const bool timed = !estimate.stamps_ns.empty() && !truth.stamps_ns.empty();
  TrajectoryPairs pairs =
      timed ? pair_by_time(estimate, truth, rules) : pair_by_number(estimate, truth, rules.offset_s);
  pairs.is_planar = estimate.is_planar || truth.is_planar;
  return pairs;
}

}  // namespace stereobench::harness
