#include "harness/detector_faults/fault_draws.h"

#include "slam/types.h"

namespace stereobench::harness {

std::uint64_t detection_key(int ball, int repeat) {
  constexpr std::uint64_t kOfNoBall = 255;  // worlds have at most 254 balls
  const std::uint64_t number = ball == slam::kUnknown ? kOfNoBall : static_cast<std::uint64_t>(ball);
  return number + 256 * static_cast<std::uint64_t>(repeat);
}

slam::RandomStream fault_draws(std::uint64_t seed, FaultDraw fault, std::uint64_t frame,
                               std::uint64_t detection) {
  const std::uint64_t index = static_cast<std::uint64_t>(fault) << 56 | frame << 24 | detection;
  return {seed, slam::Stream::kDetectorFault, index};
}

}  // namespace stereobench::harness
