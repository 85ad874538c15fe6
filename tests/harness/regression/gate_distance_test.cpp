// How far a gate is from what is measured.
#include "tests/harness/regression/gate_distance.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Json = nlohmann::ordered_json;

constexpr auto kAtMost = Gate::Relation::kAtMost;
constexpr auto kAtLeast = Gate::Relation::kAtLeast;

/// Four seeds. The mean of the filter's errors is 2.5, its standard error sqrt(5 / 3) / 2 = 0.645; the counts
/// of failures are 0, those of refused sightings 10 with a standard error of 4 x 0.645; 500 balls, all found.
Json run() {
  return Json::parse(R"({
    "vision": {"recall": 1.0, "precision": 0.75, "visible": 500, "observations": 520, "misidentified": 0},
    "filters": {"ekf": {"ate_rms_m": {"mean": 2.5}, "anees": {"mean": null}, "failures": 0, "refused": 10,
                        "even": {"mean": 2.0}}},
    "per_seed": {"vision.recall": [1, 1, 1, 1], "vision.precision": [0.6, 0.7, 0.8, 0.9],
                 "vision.misidentified": [0, 0, 0, 0], "filters.ekf.ate_rms_m": [1, 2, 3, 4],
                 "filters.ekf.anees": [null, null, null, null], "filters.ekf.failures": [0, 0, 0, 0],
                 "filters.ekf.refused": [1, 2, 3, 4], "filters.ekf.even": [2, 2, 2, 2]}})");
}

GateDistance distance(const std::string& metric, Gate::Relation relation, double limit) {
  return gate_distances(run(), std::vector{Gate{metric, relation, limit}}).at(0);
}

const double kErrorOfMean = std::sqrt(5.0 / 3.0) / 2.0;

// Mutations: the standard deviation in place of the mean's; one relation the wrong way round.
TEST(GateDistance, IsInStandardErrorsOfTheMeanOverTheSeeds) {
  const std::string ate = "filters.ekf.ate_rms_m.mean";
  EXPECT_NEAR(distance(ate, kAtMost, 2.5 + 2.0 * kErrorOfMean).standard_errors, 2.0, 1e-12);
  EXPECT_NEAR(distance(ate, kAtLeast, 2.5 - 2.0 * kErrorOfMean).standard_errors, 2.0, 1e-12);
  EXPECT_FALSE(distance(ate, kAtMost, 2.5 + 2.99 * kErrorOfMean).is_far());
  EXPECT_TRUE(distance(ate, kAtMost, 2.5 + 3.01 * kErrorOfMean).is_far());
  EXPECT_TRUE(distance(ate, kAtMost, 2.4).is_broken());
  EXPECT_TRUE(distance(ate, kAtLeast, 2.6).is_broken());
}

// Mutations: the standard error of a count's mean; a standard error of zero for what never happened.
TEST(GateDistance, OfCountsIsByTheirSum) {
  EXPECT_NEAR(distance("filters.ekf.refused", kAtMost, 10.0 + 8.0 * kErrorOfMean).standard_errors, 2.0,
              1e-12);
  EXPECT_EQ(distance("filters.ekf.failures", kAtMost, 3.0).standard_errors, 3.0);
  EXPECT_TRUE(distance("vision.misidentified", kAtMost, 4.0).is_far());
  EXPECT_EQ(distance("vision.misidentified", kAtMost, 0.0).standard_errors, 0.0);
}

// All of 500 were found: 3 of 500 may be lost. Mutation: the observations' number for that of the balls.
TEST(GateDistance, OfARateAtItsBoundIsTheRuleOfThree) {
  EXPECT_NEAR(distance("vision.recall", kAtLeast, 1.0 - 3.0 / 500.0).standard_errors, 3.0, 1e-9);
  EXPECT_TRUE(distance("vision.recall", kAtLeast, 0.99).is_far());
  const double spread = std::sqrt(0.05 / 3.0) / 2.0;
  EXPECT_NEAR(distance("vision.precision", kAtLeast, 0.75 - spread).standard_errors, 1.0, 1e-9);
}

// Mutations: what has no value passes; a limit off a value without spread passes.
TEST(GateDistance, WithoutAValueOrASpreadIsNoneThatPasses) {
  EXPECT_TRUE(distance("filters.ekf.anees.mean", kAtMost, 9.0).is_broken());
  EXPECT_TRUE(distance("filters.ekf.even.mean", kAtMost, 2.001).is_far());
  EXPECT_EQ(distance("filters.ekf.even.mean", kAtMost, 2.0).standard_errors, 0.0);
  EXPECT_THAT([] { distance("filters.ekf.atee", kAtMost, 1.0); },
              ThrowsMessage<std::runtime_error>(HasSubstr("has no such number")));
}

TEST(GateDistance, StandsBesideItsGate) {
  const std::string table =
      distance_table(gate_distances(run(), std::vector{Gate{"filters.ekf.ate_rms_m.mean", kAtMost, 9.0},
                                                       Gate{"filters.ekf.failures", kAtMost, 0.0}}));
  EXPECT_THAT(table,
              testing::ContainsRegex("filters.ekf.ate_rms_m.mean +<= 9 +2.500 +0.645[0-9]* +10.1 +too far"));
  EXPECT_THAT(table, testing::ContainsRegex("filters.ekf.failures +<= 0 +0"));
}

}  // namespace
}  // namespace stereobench::harness
