#include "worlds/oracle.h"

#include <cmath>

#include "slam/measurement.h"
#include "slam/motion.h"

namespace stereobench::worlds {

std::vector<slam::RangeBearing> sense(const World& world, const slam::Pose& world_from_robot,
                                      const OracleSensor& sensor, Identity identity,
                                      slam::RandomStream& noise) {
  std::vector<slam::RangeBearing> sightings;
  for (std::size_t id = 0; id < world.balls.size(); ++id) {
    const Eigen::Vector2d truth =
        slam::predict_sighting(world_from_robot, world.balls[id].centre_m.head<2>());
    const double range_m = truth.x();
    const double bearing_rad = truth.y();
    if (range_m > sensor.max_range_m || std::abs(bearing_rad) > sensor.field_of_view_rad / 2.0) continue;

    slam::RangeBearing sighting;
    sighting.range_m = range_m + sensor.range_sd_m * noise.normal();
    sighting.bearing_rad = slam::wrap_angle(bearing_rad + sensor.bearing_sd_rad * noise.normal());
    sighting.covariance.diagonal() << sensor.range_sd_m * sensor.range_sd_m,
        sensor.bearing_sd_rad * sensor.bearing_sd_rad;
    if (identity == Identity::kKnown) sighting.landmark_id = static_cast<int>(id);
    if (identity == Identity::kColourClass) sighting.colour_class = world.balls[id].colour;
    if (sighting.range_m >= 0.0) sightings.push_back(sighting);
  }
  return sightings;
}

}  // namespace stereobench::worlds
