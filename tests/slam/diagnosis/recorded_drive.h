// The drive of checks.h as a log.
#pragma once

#include <vector>

#include "slam/reference/batch.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {

inline std::vector<BatchStep> recorded(const Drive& world, std::uint64_t seed) {
  RandomStream odometry(seed, Stream::kOdometry);
  RandomStream sensor(seed, Stream::kOracle);
  Pose truth;
  std::vector<BatchStep> steps;
  for (const Control& control : world.controls()) {
    truth = advance(truth, control);
    steps.push_back({{perturb(control, world.odometry_noise, odometry)}, world.look(truth, sensor)});
  }
  return steps;
}

}  // namespace stereobench::slam
