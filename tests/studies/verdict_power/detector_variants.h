/// Detectors that differ from a given one in a known way, for the study of verdicts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/filter_config.h"
#include "slam/math/random.h"
#include "vision/types.h"

namespace stereobench::harness {

using Observations = std::vector<vision::BallObservation>;

/// What a variant is given: what the detector found in a frame, and in the frame before.
struct Found {
  const Observations& now;
  const Observations& before;
  const vision::StereoRig& rig;
  double ball_radius_m = 0.0;
};

/// A planted fault: of the detector, or of what a filter believes.
struct Variant {
  std::string name;
  std::vector<std::string> metrics;  ///< of which one at least is to be REGRESSED; none: nothing is
  std::vector<std::string> says;     ///< all that the report is to say; none: nothing special
  std::function<Observations(const Found&, slam::RandomStream&)> detect;
  std::function<void(slam::FilterConfig&)> believe = [](slam::FilterConfig&) {};
};

/// The detector itself, and the planted faults.
std::vector<Variant> faulty_variants();

/// The detector with centres that are off by chance: of the same quality, whatever the seed.
Variant noisy_variant(double sd_px);

}  // namespace stereobench::harness
