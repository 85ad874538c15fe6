#include "harness/logs/repeated_sightings.h"

#include <algorithm>
#include <functional>

namespace stereobench::harness {
namespace {

bool same_reading(const slam::RangeBearing& a, const slam::RangeBearing& b) {
  return a.landmark_id == b.landmark_id && a.colour_class == b.colour_class && a.range_m == b.range_m &&
         a.bearing_rad == b.bearing_rad;
}

bool same_name(const slam::RangeBearing& a, const slam::RangeBearing& b) {
  return a.landmark_id != slam::kUnknown && a.landmark_id == b.landmark_id;
}

using Alike = std::function<bool(const slam::RangeBearing&, const slam::RangeBearing&)>;

/// Whether one like a sighting is among those before it that belong to its instant.
bool has_alike_before(const std::vector<LoggedSighting>& before, const LoggedSighting& sighting,
                      const Alike& alike) {
  for (auto other = before.rbegin(); other != before.rend(); ++other) {
    if (sighting.stamp_ns - other->stamp_ns > kSameInstant_ns) return false;
    if (alike(other->measurement, sighting.measurement)) return true;
  }
  return false;
}

}  // namespace

long drop_repeated(std::vector<LoggedSighting>& sightings) {
  std::vector<LoggedSighting> kept;
  for (const LoggedSighting& sighting : sightings)
    if (!has_alike_before(kept, sighting, same_reading)) kept.push_back(sighting);
  const auto dropped = static_cast<long>(sightings.size() - kept.size());
  sightings = std::move(kept);
  return dropped;
}

long count_concurrent(const std::vector<LoggedSighting>& sightings) {
  std::vector<LoggedSighting> before;
  long count = 0;
  for (const LoggedSighting& sighting : sightings) {
    count += has_alike_before(before, sighting, same_name) ? 1 : 0;
    before.push_back(sighting);
  }
  return count;
}

}  // namespace stereobench::harness
