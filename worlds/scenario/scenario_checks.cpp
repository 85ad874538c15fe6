#include "worlds/scenario/scenario_checks.h"

#include <cmath>

#include <fmt/format.h>

namespace stereobench::worlds {
namespace {

/// The least distance on the floor that two balls have under any seed's jitter.
double least_distance_m(const Scenario& scenario, const Ball& a, const Ball& b) {
  const double moved_m = 2.0 * std::sqrt(2.0) * scenario.placement_jitter_m;
  return (a.centre_m - b.centre_m).head<2>().norm() - moved_m;
}

/// What is wrong with two balls beside each other, or nothing.
std::string fault_of_pair(const Scenario& scenario, std::size_t i, std::size_t j) {
  const Ball& a = scenario.world.balls[i];
  const Ball& b = scenario.world.balls[j];
  const bool stereo = scenario.sensor == SensorKind::kStereo;
  const double distance_m = least_distance_m(scenario, a, b);
  const double tolerance_m = 2.0 * kMostRadiusSds * scenario.world.ball_radius_sd_m;
  if (stereo && std::abs(a.radius_m - b.radius_m) > tolerance_m) {
    return fmt::format("expected the radius of ball {}, {:g} m (got {:g} m): stereo needs one size", i,
                       a.radius_m, b.radius_m);
  }
  if (distance_m < a.radius_m + b.radius_m + tolerance_m) {
    return fmt::format("expected a place clear of ball {} under any jitter (got {:.3f} m between centres)", i,
                       distance_m);
  }
  if (a.colour != b.colour && scenario.identity != Identity::kNone) return {};
  if (stereo && scenario.identity == Identity::kKnown) {
    return fmt::format("expected a colour of its own (got {}, as ball {}): identity is known by colour",
                       b.colour, i);
  }
  if (scenario.identity != Identity::kKnown && distance_m < scenario.colour_spacing_m) {
    return fmt::format("expected ball {}{} at least {:g} m away (got {:.3f} m)", i,
                       scenario.identity == Identity::kNone ? "" : " of the same colour",
                       scenario.colour_spacing_m, distance_m);
  }
  return {};
}

}  // namespace

void check_balls(const Scenario& scenario, const YamlValue& list) {
  const std::vector<Ball>& balls = scenario.world.balls;
  for (std::size_t j = 0; j < balls.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const std::string fault = fault_of_pair(scenario, i, j);
      if (!fault.empty()) list.list(1, balls.size())[j].refuse(fault);
    }
  }
}

}  // namespace stereobench::worlds
