#include "harness/detector_faults/fault_draws.h"

#include <set>

#include <gtest/gtest.h>

#include "slam/types.h"

namespace stereobench::harness {
namespace {

constexpr FaultDraw kAll[] = {FaultDraw::kCentre,    FaultDraw::kTail,       FaultDraw::kMiss,
                              FaultDraw::kBurst,     FaultDraw::kPairing,    FaultDraw::kSwap,
                              FaultDraw::kConfusion, FaultDraw::kFalseCount, FaultDraw::kFalse};

// Mutations: a fault with the numbers of another; parts of the key that overlap in long drives; a second
// detection of a ball with the errors of the first.
TEST(FaultDraws, AreOthersForEachSeedFaultFrameAndDetection) {
  std::set<std::uint32_t> first;
  std::size_t keys = 0;
  for (const std::uint64_t seed : {0U, 1U})
    for (const FaultDraw fault : kAll)
      for (const std::uint64_t frame :
           {0ULL, 1ULL, 255ULL, 256ULL, 65'536ULL, 65'537ULL, 1ULL << 24, 1ULL << 31})
        for (const int ball : {slam::kUnknown, 0, 1, 253})
          for (const int repeat : {0, 1, 255}) {
            slam::RandomStream draws = fault_draws(seed, fault, frame, detection_key(ball, repeat));
            first.insert(draws.bits());
            ++keys;
          }
  EXPECT_GE(first.size() + 1, keys) << "of 1728 numbers of 32 bits two are equal with a probability of 3e-4";
}

}  // namespace
}  // namespace stereobench::harness
