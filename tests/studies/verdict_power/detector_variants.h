/// Detectors that differ from ours in a known way, for the study of verdicts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/filter_config.h"
#include "slam/math/random.h"
#include "vision/types.h"

namespace stereobench::harness {

using Observations = std::vector<vision::BallObservation>;

/// What a variant is given: what our detector found in a frame, and in the frame before.
struct FoundByOurs {
  const Observations& now;
  const Observations& before;
  const vision::StereoRig& rig;
  double ball_radius_m = 0.0;
};

/// A detector, or a filter's belief, that differs from ours.
struct Variant {
  std::string name;
  std::vector<std::string> metrics;  ///< of which one at least is to be REGRESSED; none: nothing is
  std::string says;                  ///< what the report is to say; empty: nothing special
  std::function<Observations(const FoundByOurs&, slam::RandomStream&)> detect;
  std::function<void(slam::FilterConfig&)> believe = [](slam::FilterConfig&) {};
};

/// Ours, and the planted faults.
std::vector<Variant> faulty_variants();

/// Ours with centres that are off by chance: of the same quality, whatever the seed.
Variant noisy_variant(double sd_px);

}  // namespace stereobench::harness
