/// Oracles: what makes a part of an experiment perfect, as lines of its scenario.
#pragma once

#include <string>
#include <vector>

#include "harness/experiment/types.h"

namespace stereobench::harness {

/// Noise that is perfect is so many times the noise there is: small beside it, and not zero, of which the
/// bound could not be computed.
inline constexpr double kPerfectNoise = 0.01;

/// The estimator as a part of the chain: perfect, it reaches the Cramer-Rao bound.
inline constexpr const char* kEstimator = "estimator";

/// A part of the chain, and the lines that make it perfect.
struct Oracle {
  std::string part;
  std::string says;              ///< what becomes perfect
  std::vector<std::string> set;  ///< "key=value"
  bool is_noise = true;  ///< false: its errors are no noise, and the Cramer-Rao bound knows nothing of them
};

/// The parts of an experiment that are not perfect as they are, in the order of the chain: image_noise,
/// timing, rig, detection, identities, odometry. Filters are told what they were told before: they weigh all
/// as they did, so that errors of different parts add up. (Our detector states smaller errors where pixels
/// have no noise, as it is told how noisy they are.)
std::vector<Oracle> oracles_of(const Experiment& experiment);

}  // namespace stereobench::harness
