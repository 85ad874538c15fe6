#include "slam/association/frame_reader.h"

#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {

std::vector<Sighting> FrameReader::read(std::span<const RangeBearing> sightings, long& rejected) {
  std::vector<Sighting> frame;
  frame.reserve(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const RangeBearing& seen = sightings[i];
    const int number = given_++;
    if (!is_valid(seen)) {
      ++rejected;
      continue;
    }
    const int slot = seen.landmark_id >= 0 ? slot_for(seen) : kUnknown;
    frame.push_back({observe(seen, config_), slot, seen.colour_class, number, static_cast<int>(i)});
  }
  return frame;
}

int FrameReader::slot_for(const RangeBearing& sighting) {
  const int next = static_cast<int>(first_sightings_.size());
  const auto [found, is_new] = slot_of_id_.emplace(sighting.landmark_id, next);
  if (is_new) first_sightings_.push_back(sighting);
  return found->second;
}

}  // namespace stereobench::slam
