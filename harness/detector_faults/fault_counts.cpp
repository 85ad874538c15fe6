#include "harness/detector_faults/fault_counts.h"

#include <nlohmann/json.hpp>

namespace stereobench::harness {

FaultCounts& FaultCounts::operator+=(const FaultCounts& other) {
  moved += other.moved;
  lost += other.lost;
  added += other.added;
  renamed += other.renamed;
  delayed += other.delayed;
  undelivered += other.undelivered;
  return *this;
}

nlohmann::ordered_json fault_counts_json(const FaultCounts& counts) {
  return {{"moved", counts.moved},     {"lost", counts.lost},       {"added", counts.added},
          {"renamed", counts.renamed}, {"delayed", counts.delayed}, {"undelivered", counts.undelivered}};
}

}  // namespace stereobench::harness
