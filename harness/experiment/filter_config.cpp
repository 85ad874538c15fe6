#include "harness/experiment/filter_config.h"

#include "worlds/visibility/visibility.h"

namespace stereobench::harness {

slam::SensorSector sector_of(const worlds::OracleSensor& sensor) {
  return {sensor.max_range_m, sensor.field_of_view_rad / 2.0, sensor.miss_probability, sensor.false_per_look};
}

Eigen::Matrix3d start_covariance(const worlds::StartNoise& noise) {
  return Eigen::Vector3d(noise.position_sd_m, noise.position_sd_m, noise.heading_sd_rad)
      .cwiseAbs2()
      .asDiagonal();
}

slam::FilterConfig filter_config(const Experiment& experiment) {
  const worlds::Scenario& scenario = experiment.scenario;
  const FilterBeliefs& believed = experiment.believed;
  slam::FilterConfig config;
  config.particles = experiment.particles;
  config.draw_every = experiment.draw_every;
  config.odometry_noise = believed.odometry_noise.value_or(scenario.odometry_noise);
  config.start_covariance = start_covariance(believed.start_noise.value_or(scenario.start_noise));
  config.noise_law = believed.measurement_noise;
  config.stated_sd_scale = believed.stated_sd_scale;
  config.colour_spacing_m = scenario.colour_spacing_m;
  config.association = experiment.association;
  if (scenario.sensor == worlds::SensorKind::kOracle)
    config.sector = believed.sector.value_or(sector_of(scenario.oracle));
  if (scenario.sensor == worlds::SensorKind::kStereo && scenario.identity == worlds::Identity::kNone) {
    const auto [range_m, half_angle_rad] =
        worlds::view_sector(scenario.believed_rig, scenario.world.ball_radius_m());
    config.sector = {range_m, half_angle_rad, 1.0, 0.0};  // what is not seen may be hidden
  }
  return config;
}

}  // namespace stereobench::harness
