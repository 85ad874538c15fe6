/// Whose bytes are the same, and how close those are that are not: each of these renders in a process of its
/// own. Threads share out tiles and vectors hold pixels side by side: neither touches arithmetic. Fused
/// multiply-add does, which the rasteriser uses where the CPU has it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/backend.h"
#include "tests/renderer/frames.h"
#include "tests/renderer/in_software.h"

namespace stereobench::renderer {
namespace {

constexpr int kRooms = 3;
constexpr const char* kLesserGlibc = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA";
constexpr const char* kLesserOpenCv = "OPENCV_CPU_DISABLE=SSE4.1,SSE4.2,AVX,FP16,AVX2";

class Determinism : public test::EachInSoftware {
 protected:
  std::vector<StereoFrame> frames(const char* environment) const {
    return test::frames_of_process(environment, GetParam(), kRooms);
  }
};

// "avx" takes AVX-512 away and nothing else. Mutation: a place that depends on the clock by a micrometre.
TEST_P(Determinism, SameBytesRunToRunForAnyThreadsVectorsAndCaches) {
  const auto usual = frames("");
  for (const char* environment :
       {"", "LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "LP_NATIVE_VECTOR_WIDTH=128",
        "MESA_SHADER_CACHE_DISABLE=true", "GALLIUM_OVERRIDE_CPU_CAPS=avx", kLesserOpenCv}) {
    const auto other = frames(environment);
    for (std::size_t room = 0; room < usual.size(); ++room) {
      EXPECT_TRUE(test::same(usual[room], other[room])) << environment << ", room " << room;
    }
  }
}

// Mutation: no allowance of a level: a hundred pixels of a million are off by one.
TEST_P(Determinism, SameIdsAndColoursWithinALevelOnCpusWithoutFusedMultiplyAdd) {
  const std::string everything =
      fmt::format("GALLIUM_OVERRIDE_CPU_CAPS=sse2 {} {}", kLesserGlibc, kLesserOpenCv);
  const auto usual = frames("");
  for (const char* environment : {"GALLIUM_OVERRIDE_CPU_CAPS=sse4.1", "GALLIUM_OVERRIDE_CPU_CAPS=sse2",
                                  kLesserGlibc, everything.c_str()}) {
    const auto other = frames(environment);
    for (std::size_t room = 0; room < usual.size(); ++room) {
      const test::Difference difference = test::difference(usual[room], other[room]);
      EXPECT_EQ(difference.ids, 0) << environment << ", room " << room;
      EXPECT_EQ(difference.colours, 0) << environment << ", room " << room;
      EXPECT_EQ(difference.depths, 0) << environment << ", room " << room;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, Determinism, test::kInSoftware);

}  // namespace
}  // namespace stereobench::renderer
