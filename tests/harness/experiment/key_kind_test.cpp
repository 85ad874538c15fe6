#include "harness/experiment/key_kind.h"

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

// Mutations: the last part of a path looked up in the wrong group; all keys of numbers.
TEST(KeyKind, KnowsKeysOfWholeNumbers) {
  for (const char* key :
       {"particles", "detector_noise.latency_frames", "faults.camera.blur", "shutter.samples"})
    EXPECT_TRUE(takes_whole_numbers(key)) << key;
  for (const char* key : {"placement_jitter_m", "detector_noise.centre_sd_px", "detector_noise",
                          "no.such.key", "particles.x", "camera.", ""})
    EXPECT_FALSE(takes_whole_numbers(key)) << key;
}

}  // namespace
}  // namespace stereobench::harness
