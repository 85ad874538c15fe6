#include "worlds/oracle.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::worlds {
namespace {

slam::RangeBearing measured(const Eigen::Vector2d& range_bearing, const OracleSensor& sensor,
                            slam::RandomStream& noise) {
  slam::RangeBearing sighting;
  sighting.range_m = range_bearing.x() + sensor.range_sd_m * noise.normal();
  sighting.bearing_rad = slam::wrap_angle(range_bearing.y() + sensor.bearing_sd_rad * noise.normal());
  sighting.covariance.diagonal() << sensor.range_sd_m * sensor.range_sd_m,
      sensor.bearing_sd_rad * sensor.bearing_sd_rad;
  return sighting;
}

/// The product of uniform numbers falls below e^-mean after Poisson many of them (Knuth).
int poisson(double mean, slam::RandomStream& chance) {
  const double limit = slam::exponential(-mean);
  int count = 0;
  for (double product = chance.uniform(); product > limit; product *= chance.uniform()) ++count;
  return count;
}

slam::RangeBearing imagined(const World& world, const OracleSensor& sensor, Identity identity,
                            slam::RandomStream& chance) {
  slam::RangeBearing sighting;
  sighting.range_m = sensor.max_range_m * std::sqrt(chance.uniform());  // area grows with the square
  sighting.bearing_rad = slam::wrap_angle(sensor.field_of_view_rad * (chance.uniform() - 0.5));
  sighting.covariance.diagonal() << sensor.range_sd_m * sensor.range_sd_m,
      sensor.bearing_sd_rad * sensor.bearing_sd_rad;
  if (identity == Identity::kColourClass) {
    const double ball = std::floor(chance.uniform() * static_cast<double>(world.balls.size()));
    sighting.colour_class = world.balls[static_cast<std::size_t>(ball)].colour;
  }
  return sighting;
}

}  // namespace

Sightings sense(const World& world, const slam::Pose& world_from_robot, const OracleSensor& sensor,
                Identity identity, slam::RandomStream& noise) {
  Sightings look;
  for (std::size_t id = 0; id < world.balls.size(); ++id) {
    const Eigen::Vector2d truth =
        slam::predict_sighting(world_from_robot, world.balls[id].centre_m.head<2>());
    if (truth.x() > sensor.max_range_m || std::abs(truth.y()) > sensor.field_of_view_rad / 2.0) continue;
    slam::RangeBearing sighting = measured(truth, sensor, noise);
    if (identity == Identity::kKnown) sighting.landmark_id = static_cast<int>(id);
    if (identity == Identity::kColourClass) sighting.colour_class = world.balls[id].colour;
    if (sighting.range_m < 0.0) continue;
    look.measurements.push_back(sighting);
    look.balls.push_back(static_cast<int>(id));
  }
  return look;
}

Sightings with_faults(const Sightings& look, const World& world, const OracleSensor& sensor,
                      Identity identity, slam::RandomStream& chance) {
  Sightings left;
  for (std::size_t i = 0; i < look.measurements.size(); ++i) {
    if (sensor.miss_probability > 0.0 && chance.uniform() < sensor.miss_probability) continue;
    left.measurements.push_back(look.measurements[i]);
    left.balls.push_back(look.balls[i]);
  }
  const int imaginary = sensor.false_per_look > 0.0 ? poisson(sensor.false_per_look, chance) : 0;
  for (int i = 0; i < imaginary; ++i) {
    left.measurements.push_back(imagined(world, sensor, identity, chance));
    left.balls.push_back(slam::kUnknown);
  }
  return left;
}

}  // namespace stereobench::worlds
