#include "harness/regression_commands/suite_plan.h"

#include <gtest/gtest.h>

#include "tests/harness/regression_commands/tiny_suite.h"

namespace stereobench::harness {
namespace {

// Levels of a detector's faults cost one rendering. Mutations: a key of pictures with the faults in it; one
// without the camera.
TEST(SuitePlan, LetsWorseDetectorsSeeTheSamePictures) {
  const TinySuite suite(
      "  - {name: plain, scenario: room.yaml}\n"
      "  - {name: worse, scenario: room.yaml, set: ['detector_noise={centre_sd_px: 0.3}']}\n"
      "  - {name: named, scenario: room.yaml, set: [faults.detector.centre_noise=3]}\n"
      "  - {name: other, scenario: room.yaml, set: [camera.noise_sd_levels=3]}\n");
  const SuitePlan plan = plan_suite({.suite = suite.path("tiny.yaml")});
  ASSERT_EQ(plan.cases.size(), 4U);
  EXPECT_EQ(plan.cases[1].pictures, plan.cases[0].pictures);
  EXPECT_EQ(plan.cases[2].pictures, plan.cases[0].pictures);
  EXPECT_NE(plan.cases[3].pictures, plan.cases[0].pictures);
}

}  // namespace
}  // namespace stereobench::harness
