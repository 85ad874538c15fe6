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

constexpr const char* kAsItIs = "the same";  ///< the variant that changes nothing

/// A planted fault: of the detector, or of what a filter believes.
struct Variant {
  std::string name;
  std::vector<std::string> metrics;  ///< of which one at least is to be REGRESSED; none: nothing is
  std::vector<std::string> says;     ///< all that the report is to say; none: nothing special
  std::function<Observations(const Found&, slam::RandomStream&)> detect;
  std::function<void(slam::FilterConfig&)> believe = [](slam::FilterConfig&) {};
  std::string beside = kAsItIs;  ///< the variant that it is compared with
};

/// The detector itself, and the planted faults.
/// @param nis_per_degree mean NIS / 2 of the detector on other seeds: its covariance times this is
///        consistent. Half of a covariance that is too large would be an improvement.
/// @param coarser_belief by what the filter's odometry noise is multiplied in the last fault
std::vector<Variant> faulty_variants(double nis_per_degree, double coarser_belief);

/// The detector with centres that are off by chance: of the same quality, whatever the seed.
Variant noisy_variant(double sd_px);

}  // namespace stereobench::harness
