/// The settings of the rules by which all filters give sightings to landmarks and keep their maps.
#pragma once

#include <algorithm>
#include <cmath>

#include "slam/association/existence.h"
#include "slam/association/sighting.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {

/// What the rules of association.h, contradiction.h and map_management.h are told.
struct AssociationPolicy {
  /// By what share of the true control a reported one may be too small, at most.
  static constexpr double kMostMissing = 0.6;

  explicit AssociationPolicy(const FilterConfig& config)
      : gate_probability(config.gate_probability),
        gate(chi_square_2_quantile(config.gate_probability)),
        near_m(0.5 * config.colour_spacing_m),
        association(config.association),
        merges(config.merge_doubles && config.association == Association::kJoint &&
               !(config.colour_spacing_m > 0.0) && config.sector.range_m > 0.0),
        existence(config.sector) {
    const OdometryNoise& noise = config.odometry_noise;
    const double share = std::max(noise.v_per_v, noise.w_per_w);
    const double missing = share > 0.0 ? std::min(std::sqrt(gate) * share, kMostMissing) : 0.0;
    motion_scale = 1.0 / ((1.0 - missing) * (1.0 - missing));
  }

  /// @return whether the spacing of colours is known, so that landmarks nearby exclude new ones
  bool near_excludes() const { return near_m > 0.0; }

  /// @return a motion that landmarks without an identity are searched with
  PoseBelief search_motion(const PoseBelief& motion) const {
    return {motion.mean, motion_scale * motion.covariance};
  }

  /// @return whether a sighting can be of no other landmark than the one that it was given to
  bool is_certain(const Sighting& sighting) const { return sighting.slot == kUnknown && near_excludes(); }

  double gate_probability;
  double gate;    ///< squared Mahalanobis length of that probability, beyond which sightings are refused
  double near_m;  ///< within this distance there is one landmark of a colour; 0 = not known
  /// How much larger than believed the covariance of a motion may be, for the search for a landmark without
  /// an identity. Noise in proportion to a control is believed in proportion to the reported one,
  /// r = (1 + share z) true. With z at the gate, -g, the error g share true is g share r / (1 - g share).
  double motion_scale = 1.0;
  Association association;
  /// Whether what may be an old landmark is a new one until the map as a whole tells that it is not. It takes
  /// a belief that ties landmarks to each other, and a sensor that says how many there are.
  bool merges;
  Existence existence;
};

}  // namespace stereobench::slam
