/// How a landmark has fared.
#pragma once

#include <cstdint>
#include <limits>

namespace stereobench::slam {

/// How often a landmark was agreed with and contradicted. It stops counting where two bytes end, far beyond
/// what any decision asks for: a landmark then fills a cache line and no more.
struct TrackRecord {
  std::uint16_t uses = 1;      ///< sightings that agreed with it, the first included
  std::uint16_t refusals = 0;  ///< sightings since the last agreement that contradicted it

  void agree() {
    uses = one_more(uses);
    refusals = 0;
  }
  void contradict() { refusals = one_more(refusals); }

 private:
  static std::uint16_t one_more(std::uint16_t count) {
    return count < std::numeric_limits<std::uint16_t>::max() ? static_cast<std::uint16_t>(count + 1) : count;
  }
};

}  // namespace stereobench::slam
