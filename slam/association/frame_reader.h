/// From sightings as they come in to a frame that a filter can use.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "slam/association/sighting.h"
#include "slam/filter_config.h"

namespace stereobench::slam {

/// Checks sightings, says what noise is believed of them, and numbers the identities in order of appearance.
class FrameReader {
 public:
  explicit FrameReader(const FilterConfig& config) : config_(config) {}

  /// @param sightings of one instant
  /// @param rejected counts those that cannot be and are left out
  /// @return the others, in their order, each with its number and the slot of its identity
  std::vector<Sighting> read(std::span<const RangeBearing> sightings, long& rejected);

  /// @return what was seen when a slot was given out: identity and colour of its landmark
  const RangeBearing& first_sighting(std::size_t slot) const { return first_sightings_[slot]; }

 private:
  int slot_for(const RangeBearing& sighting);

  FilterConfig config_;
  int given_ = 0;
  std::map<int, int> slot_of_id_;
  std::vector<RangeBearing> first_sightings_;  ///< by slot
};

}  // namespace stereobench::slam
