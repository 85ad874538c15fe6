/// The settings of the rules by which all filters give sightings to landmarks and keep their maps.
#pragma once

#include "slam/association/existence.h"
#include "slam/association/sighting.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {

/// What the rules of association.h, contradiction.h and map_management.h are told.
struct AssociationPolicy {
  explicit AssociationPolicy(const FilterConfig& config)
      : gate_probability(config.gate_probability),
        gate(chi_square_2_quantile(config.gate_probability)),
        near_m(0.5 * config.colour_spacing_m),
        association(config.association),
        existence(config.sector) {}

  /// @return whether the spacing of colours is known, so that landmarks nearby exclude new ones
  bool near_excludes() const { return near_m > 0.0; }

  /// @return whether a sighting can be of no other landmark than the one that it was given to
  bool is_certain(const Sighting& sighting) const { return sighting.slot == kUnknown && near_excludes(); }

  double gate_probability;
  double gate;    ///< squared Mahalanobis length of that probability, beyond which sightings are refused
  double near_m;  ///< within this distance there is one landmark of a colour; 0 = not known
  Association association;
  Existence existence;
};

}  // namespace stereobench::slam
