/// Shards that contradict each other.
#pragma once

#include <stdexcept>

namespace stereobench::harness {

/// Two shards have different bytes where they must have the same, or results are not as they were written:
/// one of the machines computes, renders or stores differently.
class ShardConflict : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace stereobench::harness
