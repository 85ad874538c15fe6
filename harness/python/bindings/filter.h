/// Filters that Python takes step by step, and estimates that it made itself.
#pragma once

#include <string>
#include <vector>

#include "harness/python/bindings/drive.h"
#include "harness/scoring/replay.h"

namespace stereobench::harness::bindings {

/// One of our filters on a drive.
class PyFilter {
 public:
  /// @param particles 0: as the scenario says
  PyFilter(const std::string& name, DrivePointer drive, int particles);

  void step(const std::vector<slam::Control>& odometry, const std::vector<slam::RangeBearing>& measurements);
  slam::Estimate estimate() const { return slam::estimate(replay_.filter()); }
  slam::Estimate estimate_without_map() const { return slam::estimate_without_map(replay_.filter()); }
  FilterRun run() const { return replay_.run(truth_); }
  const std::string& name() const { return name_; }
  std::size_t steps() const { return step_; }

 private:
  std::string name_;
  DrivePointer drive_;
  FilterReplay replay_;
  std::size_t step_ = 0;     ///< how many there were
  std::vector<int> truth_;   ///< of each sighting so far: whose it is
  bool knows_truth_ = true;  ///< false once it was given other sightings than the drive's
};

}  // namespace stereobench::harness::bindings
