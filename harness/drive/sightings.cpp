#include "harness/drive/sightings.h"

#include <algorithm>

namespace stereobench::harness {
namespace {

/// The identity that a colour stands for; see sightings_of.
int identity_of(int colour, std::span<const worlds::Ball> balls) {
  const auto ball = std::ranges::find(balls, colour, &worlds::Ball::colour);
  const auto index = static_cast<int>(ball - balls.begin());
  return ball == balls.end() ? index + colour : index;
}

}  // namespace

Sightings sightings_of(std::span<const vision::BallObservation> observations,
                       std::span<const int> balls_observed, std::span<const worlds::Ball> balls,
                       worlds::Identity identity) {
  Sightings seen;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const vision::BallObservation& observation = observations[i];
    if (!observation.trusted()) continue;
    slam::RangeBearing measurement = observation.range_bearing;
    if (identity == worlds::Identity::kNone) measurement.colour_class = slam::kUnknown;
    if (identity == worlds::Identity::kKnown) {
      if (observation.colour == slam::kUnknown) continue;
      measurement.landmark_id = identity_of(observation.colour, balls);
    }
    seen.measurements.push_back(measurement);
    seen.balls.push_back(balls_observed[i]);
  }
  return seen;
}

void tell_names(Sightings& sightings) {
  for (std::size_t i = 0; i < sightings.balls.size(); ++i)
    if (sightings.balls[i] != slam::kUnknown) sightings.measurements[i].landmark_id = sightings.balls[i];
}

}  // namespace stereobench::harness
