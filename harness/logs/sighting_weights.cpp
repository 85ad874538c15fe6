#include "harness/logs/sighting_weights.h"

#include <algorithm>
#include <utility>

#include "harness/logs/sensor_log.h"
#include "slam/diagnosis/lasting_errors.h"

namespace stereobench::harness {

void find_sensor_sector(RecordedLog& recorded, slam::FilterConfig& config) {
  const auto is_nameless = [](const slam::RangeBearing& one) { return one.landmark_id == slam::kUnknown; };
  const std::vector<slam::BatchStep> steps = sensor_log(recorded.log).steps;
  if (std::ranges::none_of(steps, [&](const slam::BatchStep& step) {
        return std::ranges::any_of(step.sightings, is_nameless);
      }))
    return;
  recorded.facts.sector = slam::find_sector(config, steps);
  recorded.facts.sector_is_found = true;
  config.sector = recorded.facts.sector.sector;
}

void weigh_sightings(RecordedLog& recorded, const slam::FilterConfig& config,
                     const std::optional<Eigen::Vector2d>& stated_s) {
  auto [start, steps] = sensor_log(recorded.log);
  slam::LastingErrors& lasting = recorded.facts.lasting_errors;
  lasting =
      stated_s ? slam::LastingErrors{.time_s = *stated_s} : slam::find_lasting_errors(config, start, steps);
  if (lasting.time_s.isZero()) return;
  slam::weigh_by_gaps(config, start, lasting.time_s, steps);
  for (std::size_t k = 0; k < steps.size(); ++k)
    recorded.log.steps[k].measurements = std::move(steps[k].sightings);
}

}  // namespace stereobench::harness
