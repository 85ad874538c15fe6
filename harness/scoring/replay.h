/// Filters driven over a log.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/types.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {

/// One filter on its way over a log, step by step.
class FilterReplay {
 public:
  /// @param filter, config, start, seed as of slam::make_filter; reports of its updates are always asked for
  FilterReplay(const std::string& filter, slam::FilterConfig config, const slam::Pose& start,
               std::uint64_t seed);

  /// Gives it the odometry and the sightings of the next step. One that has failed stays where it is.
  /// @param truth of all sightings up to this step (true_landmarks); empty where it is not known
  void step(const LogStep& step, std::span<const int> truth);

  /// @return what the filter believes now
  const slam::Filter& filter() const { return state_; }

  /// @param truth of all sightings so far; empty: its decisions are not judged
  /// @return what it has done so far, with its present map
  FilterRun run(std::span<const int> truth) const;

 private:
  bool drive(const LogStep& step);

  FilterRun run_;
  bool has_thrown_ = false;  ///< then it believes nothing any more
  slam::Filter state_;
  std::vector<std::vector<int>> ancestors_;  ///< by step
};

/// Drives one filter over a log, from the log's start to its last step.
/// @param log what the robot measured; its truth is for scores alone
/// @param filter one of slam::filter_names()
/// @param config the filter's settings; reports of its updates are always asked for
/// @param seed of the filter's own random stream
/// @return its estimate after every step. `failed` when the filter threw or its estimate was not finite; then
///   the steps before that are kept
/// @throws std::invalid_argument when there is no such filter, or a setting or the start is out of range
FilterRun replay(const MeasurementLog& log, const std::string& filter, slam::FilterConfig config,
                 std::uint64_t seed);

}  // namespace stereobench::harness
