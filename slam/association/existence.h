/// Whether what a map holds is there at all: log odds, landmark by landmark.
#pragma once

#include <cstddef>

#include "slam/filter_config.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// How sure a particle is that a landmark exists, by what the sensor says of itself (Montemerlo and Thrun,
/// ICRA 2003, with evidence from the sensor's rates in place of constants).
///
/// Clutter founds landmarks that are never seen again. Each sighting of a landmark speaks for it by
/// log(p(seen | there) / p(clutter in its place)), and each look that should have shown it and did not
/// speaks against it by log p(missed). No sensor is taken for better than a floor: a filter also founds
/// landmarks by mistake, and refuses sightings. Where no sector is declared nothing is known of what should
/// have been seen, and every landmark is taken for real.
class Existence {
 public:
  explicit Existence(const SensorSector& sector);

  /// @return whether there is any evidence to keep account of
  bool is_tracked() const { return sector_.range_m > 0.0; }

  /// @return log odds of a landmark that was seen once: new ones against clutter
  float founded() const { return founded_; }

  /// @return log odds after a sighting
  float seen(float log_odds, const Observation& observation) const;

  /// @return log odds after a look that should have shown it
  float unseen(float log_odds) const { return log_odds + missed_; }

  /// @return whether a landmark is so far within the sector that it cannot have been beyond its border
  bool should_be_seen(const Pose& robot, const LandmarkBelief& landmark) const;

  /// Minus twice the log density, over range and bearing, of sightings of what is not in the map: new
  /// landmarks and clutter. Infinite where no sector is declared.
  double cost_of_new(const Observation& observation) const;

  /// The same of any landmark, where a look shows so many. Infinite where no sector is declared.
  double cost_of_other(const Observation& observation, std::size_t shown) const;

  /// Minus twice the log density of landmarks on the ground, 1/m^2, where a look shows so many.
  double cost_of_place(std::size_t shown) const;

  double range_m() const { return sector_.range_m; }

  /// A landmark that nothing is matched with any more.
  static bool is_dead(float log_odds) { return log_odds < kDead; }

  /// @return log odds of one
  static float dead() { return kDead - 1.0F; }

  /// A landmark that is there with 95 %: it may correct poses, and is reported.
  static bool is_believed(float log_odds) { return log_odds >= kBelieved; }

 private:
  static constexpr float kDead = -6.0F;
  static constexpr float kBelieved = 3.0F;
  static constexpr float kSurest = 10.0F;  ///< so that what has gone can be forgotten

  double cost_of(const Observation& observation, double per_m2) const;

  SensorSector sector_;
  double area_m2_ = 0.0;
  double clutter_per_m2_ = 0.0;
  float founded_ = kSurest;
  float missed_ = 0.0F;
};

}  // namespace stereobench::slam
