#include "harness/experiment/experiment_parts.h"
#include "slam/math/angles.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::harness {
namespace {

using worlds::Fields;
using worlds::number;

/// What may be believed of the oracle is what it may have.
worlds::Interval range_of(std::string_view key) {
  return worlds::oracle_keys().find(key)->within;
}

}  // namespace

const Fields<slam::SensorSector>& believed_oracle_keys() {
  static const Fields<slam::SensorSector> keys({
      number("max_range_m", {0.0, range_of("max_range_m").most},
             "How far filters believe it to see, in metres; 0: no limit.")
          .otherwise_as("oracle.max_range_m")
          .fills(&slam::SensorSector::range_m),
      number("field_of_view_deg", range_of("field_of_view_deg"),
             "Whole angle of its believed sector, in degrees.")
          .otherwise_as("oracle.field_of_view_deg")
          .times(slam::kRadPerDegree / 2.0)
          .fills(&slam::SensorSector::half_angle_rad),
      number("miss_probability", range_of("miss_probability"),
             "Believed probability that it misses a ball in view.")
          .otherwise_as("oracle.miss_probability")
          .fills(&slam::SensorSector::miss_probability),
      number("false_per_look", range_of("false_per_look"),
             "Believed mean number of sightings of nothing in a look.")
          .otherwise_as("oracle.false_per_look")
          .fills(&slam::SensorSector::false_per_look),
  });
  return keys;
}

}  // namespace stereobench::harness
