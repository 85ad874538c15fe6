#include "harness/run/sightings.h"

#include <algorithm>

namespace stereobench::harness {

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
      const auto ball = std::find_if(balls.begin(), balls.end(),
                                     [&](const worlds::Ball& b) { return b.colour == observation.colour; });
      if (ball == balls.end()) continue;  // a colour that no landmark has
      measurement.landmark_id = static_cast<int>(ball - balls.begin());
    }
    seen.measurements.push_back(measurement);
    seen.balls.push_back(balls_observed[i]);
  }
  return seen;
}

}  // namespace stereobench::harness
