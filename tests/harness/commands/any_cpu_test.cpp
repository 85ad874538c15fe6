/// The same bytes on processors that can do less.
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

/// As on a processor without fused multiply-add and wide vectors.
constexpr const char* kLesserGlibc = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-AVX";

class AnyCpu : public testing::TestWithParam<const char*> {};

// Where no pixels are involved, nothing depends on the processor. Mutation: std::atan2 in predict_sighting.
TEST_P(AnyCpu, MakesTheSameBytes) {
  const TestFolder scratch;
  const auto run_json = [&](const char* name, Environment environment) {
    const std::filesystem::path out = scratch.path() / name;
    const Outcome outcome = run_stereobench(
        {"run", scenario_path(GetParam()), "--seeds", "0..3", "--particles", "20", "--filters",
         "dead_reckoning,ekf,fastslam1,fastslam2,ufastslam", "--set", "gates=[]", "--out", out.string()},
        std::move(environment));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(out / "run.json");
  };
  EXPECT_EQ(run_json("usual", {}), run_json("lesser", {kLesserGlibc}));
}

INSTANTIATE_TEST_SUITE_P(Oracle, AnyCpu, testing::Values("open_field", "room"));

}  // namespace
}  // namespace stereobench::harness
