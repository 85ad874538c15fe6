#include "slam/filter.h"

#include <cmath>
#include <stdexcept>

namespace stereobench::slam {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("make_filter: ") + what);
}

bool is_sd(double value) {
  return std::isfinite(value) && value >= 0.0;
}

void check(const OdometryNoise& noise) {
  require(is_sd(noise.v_constant_mps) && is_sd(noise.v_per_v) && is_sd(noise.v_per_w) &&
              is_sd(noise.w_constant_radps) && is_sd(noise.w_per_v) && is_sd(noise.w_per_w),
          "odometry_noise must be finite and >= 0");
}

void check(const SensorSector& sector) {
  require(is_sd(sector.range_m) && is_sd(sector.half_angle_rad) && is_sd(sector.false_per_look),
          "sector must be finite and >= 0");
  require((sector.range_m > 0.0) == (sector.half_angle_rad > 0.0),
          "sector must have both a range and an angle, or neither");
  require(sector.miss_probability >= 0.0 && sector.miss_probability < 1.0,
          "sector.miss_probability must be in [0, 1)");
}

void check(const FilterConfig& config) {
  check(config.odometry_noise);
  require(config.particles >= 1, "particles must be >= 1");
  require(config.draw_every >= 1, "draw_every must be >= 1");
  require(is_sd(config.range_floor_m) && is_sd(config.bearing_floor_rad),
          "noise floors must be finite and >= 0");
  require(config.resample_below >= 0.0 && config.resample_below <= 1.0, "resample_below must be in [0, 1]");
  require(config.gate_probability > 0.0 && config.gate_probability <= 1.0,
          "gate_probability must be in (0, 1]");
  require(is_sd(config.colour_spacing_m), "colour_spacing_m must be finite and >= 0");
  if (const auto& law = config.noise_law) {
    require(is_sd(law->range_sd_m) && is_sd(law->range_sd_per_m2) && is_sd(law->bearing_sd_rad),
            "noise_law must be finite and >= 0");
  }
  check(config.sector);
  const UnscentedParameters& unscented = config.unscented;
  require(std::isfinite(unscented.alpha) && unscented.alpha > 0.0, "unscented.alpha must be > 0");
  require(std::isfinite(unscented.beta) && std::isfinite(unscented.kappa) && unscented.kappa > -2.0,
          "unscented.beta and kappa must be finite, kappa > -2");
}

}  // namespace

Filter make_filter(const std::string& name, const FilterConfig& config, const Pose& start,
                   std::uint64_t seed) {
  check(config);
  require(std::isfinite(start.x_m) && std::isfinite(start.y_m) && std::isfinite(start.heading_rad),
          "the start pose must be finite");
  if (name == "dead_reckoning") return DeadReckoning(config, start);
  if (name == "ekf") return EkfSlam(config, start);
  if (name == "fastslam1") return LinearisedFastSlam(config, start, seed, Proposal::kMotion);
  if (name == "fastslam2") return LinearisedFastSlam(config, start, seed, Proposal::kPosterior);
  if (name == "ufastslam") return UnscentedFastSlam(config, start, seed, Proposal::kPosterior);
  if (name == "ufastslam_kim")
    return UnscentedFastSlam(config, start, seed, Proposal::kPosterior, Updates::kAtOnce);
  if (name == "fastslam2_block") return LinearisedBlockSlam(config, start, seed);
  if (name == "ufastslam_block") return UnscentedBlockSlam(config, start, seed);
  std::string known;
  for (const std::string& filter : filter_names()) known += (known.empty() ? "" : ", ") + filter;
  throw std::invalid_argument("make_filter: no filter '" + name + "'; there are " + known);
}

void predict(Filter& filter, const Control& control) {
  std::visit([&](auto& some) { some.predict(control); }, filter);
}

void update(Filter& filter, std::span<const RangeBearing> sightings) {
  std::visit([&](auto& some) { some.update(sightings); }, filter);
}

Estimate estimate(const Filter& filter) {
  return std::visit([](const auto& some) { return some.estimate(); }, filter);
}

UpdateReport last_update(const Filter& filter) {
  return std::visit([](const auto& some) { return some.last_update(); }, filter);
}

int particle_count(const Filter& filter) {
  return std::visit([](const auto& some) { return some.particle_count(); }, filter);
}

Estimate estimate_without_map(const Filter& filter) {
  return std::visit([](const auto& some) { return some.estimate_without_map(); }, filter);
}

Decisions last_decisions(const Filter& filter) {
  return std::visit([](const auto& some) { return some.last_decisions(); }, filter);
}

}  // namespace stereobench::slam
