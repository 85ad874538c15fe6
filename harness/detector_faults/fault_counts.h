/// How many detections the faults of a detector have touched.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace stereobench::harness {

struct FaultCounts {
  long moved = 0;        ///< their centres or ranges, of those that are handed on
  long lost = 0;         ///< missed, or moved to where no ball can be
  long added = 0;        ///< of nothing
  long renamed = 0;      ///< of those that are handed on
  long delayed = 0;      ///< handed on frames after the look
  long undelivered = 0;  ///< whose frame of arrival was lost, or lies behind the end

  FaultCounts& operator+=(const FaultCounts& other);
  bool operator==(const FaultCounts&) const = default;
};

/// As run.json has it.
nlohmann::ordered_json fault_counts_json(const FaultCounts& counts);

}  // namespace stereobench::harness
