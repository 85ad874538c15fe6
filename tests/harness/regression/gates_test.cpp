#include "harness/regression/gates.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Gate kAtMostHalf{"filters.ufastslam_iterated.ate_rms_m.mean", Gate::Relation::kAtMost, 0.5};

Json result_with(const Json& mean) {
  return {{"filters", {{"ufastslam_iterated", {{"ate_rms_m", {{"mean", mean}}}}}}}};
}

std::vector<BrokenGate> broken_by(const Json& mean, Gate::Relation relation, double limit) {
  return broken_gates(result_with(mean), std::vector{Gate{kAtMostHalf.metric, relation, limit}});
}

// A value other than the limit keeps one of the two relations and breaks the other; the limit itself keeps
// both.
// Mutations: comparing the wrong way round; not letting the limit itself pass.
TEST(Gates, AValueOffTheLimitBreaksOneOfTheRelations) {
  slam::RandomStream random(1, slam::Stream::kWorld);
  for (int i = 0; i < 100; ++i) {
    const double value = random.normal();
    const double limit = random.normal();
    EXPECT_EQ(broken_by(value, Gate::Relation::kAtMost, limit).size(), value > limit ? 1U : 0U);
    EXPECT_EQ(broken_by(value, Gate::Relation::kAtLeast, limit).size(), value < limit ? 1U : 0U);
    EXPECT_TRUE(broken_by(limit, Gate::Relation::kAtMost, limit).empty());
    EXPECT_TRUE(broken_by(limit, Gate::Relation::kAtLeast, limit).empty());
  }
}

TEST(Gates, ABrokenOneSaysWhatWasExpectedAndByHowMuchItIsMissed) {
  const auto broken = broken_by(0.75, Gate::Relation::kAtMost, 0.5);
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_EQ(broken[0].value, 0.75);
  EXPECT_EQ(broken[0].message,
            "filters.ufastslam_iterated.ate_rms_m.mean is 0.75, expected at most 0.5: off by 0.250");
}

// What could not be measured keeps no limit. Mutation: letting it pass.
TEST(Gates, AMetricWithoutValueIsBroken) {
  for (const auto relation : {Gate::Relation::kAtMost, Gate::Relation::kAtLeast}) {
    const auto broken = broken_by(nullptr, relation, 0.0);
    ASSERT_EQ(broken.size(), 1U);
    EXPECT_FALSE(broken[0].value);
    EXPECT_THAT(broken[0].message, HasSubstr("has no value"));
  }
}

// Mutation: keeping all gates.
TEST(Gates, OfAFilterThatIsLeftOutAreSkippedAndOthersAreNot) {
  Experiment experiment;
  experiment.gates = {
      kAtMostHalf, {"vision.recall"}, {"filters.fastslam2_iterated.failures"}, {"filters.nobody.failures"}};
  EXPECT_EQ(gates_of(experiment).size(), 4U);
  experiment.filters = {"dead_reckoning", "fastslam2_iterated"};
  const auto gates = gates_of(experiment);
  ASSERT_EQ(gates.size(), 3U);
  EXPECT_EQ(gates[0].metric, "vision.recall");
  EXPECT_EQ(gates[1].metric, "filters.fastslam2_iterated.failures");
  EXPECT_EQ(gates[2].metric, "filters.nobody.failures");  // a slip of the pen, for check_metrics to find
}

// Mutations: no check; letting objects and text pass as numbers.
TEST(Gates, NameANumberOfTheResultBeforeAnythingIsRun) {
  Experiment experiment;
  const auto check = [&](const std::string& metric) {
    check_metrics(std::vector{Gate{metric}}, result_without_values(experiment));
  };
  for (const char* metric :
       {"vision.recall", "vision.flagged", "filters.ufastslam_iterated.ate_rms_m.mean",
        "filters.dead_reckoning.landmarks.missed", "filters.fastslam2_iterated.failures"})
    EXPECT_NO_THROW(check(metric)) << metric;
  for (const char* metric : {"", "vision", "vision.", "vision.beauty", "vision.recall.mean", "scenario",
                             "filters.nobody.failures", "filters.ufastslam_iterated.ate_rms_m"})
    EXPECT_THAT([&] { check(metric); }, ThrowsMessage<std::runtime_error>(HasSubstr(metric)));
}

// Mutation: no suggestion, or one from far away.
TEST(Gates, AMisspeltMetricIsAskedBack) {
  const auto check = [&](const std::string& metric) {
    check_metrics(std::vector{Gate{metric}}, result_without_values({}));
  };
  EXPECT_THAT([&] { check("vision.recal"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("did you mean vision.recall?")));
  EXPECT_THAT([&] { check("filters.ufastslam_iterated.ate_rms_m.maen"); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("did you mean filters.ufastslam_iterated.ate_rms_m.mean?")));
  EXPECT_THAT([&] { check("beauty"); }, ThrowsMessage<std::runtime_error>(HasSubstr("by its keys")));
}

// Mutations: the wrong relation; a limit read up to the first letter that is no number.
TEST(Gates, AreReadFromTheCommandLine) {
  const Gate most = parse_gate("filters.ufastslam_iterated.ate_rms_m.mean<=5e-2");
  EXPECT_EQ(most.metric, "filters.ufastslam_iterated.ate_rms_m.mean");
  EXPECT_EQ(most.relation, Gate::Relation::kAtMost);
  EXPECT_EQ(most.limit, 0.05);
  const Gate least = parse_gate("vision.recall>=0.98");
  EXPECT_EQ(least.relation, Gate::Relation::kAtLeast);
  EXPECT_EQ(least.limit, 0.98);
  for (const char* text :
       {"", "vision.recall", "vision.recall=1", "<=1", "vision.recall<=", "vision.recall<=1mm",
        "vision.recall<=nan", "vision.recall<=inf", "vision.recall<1"})
    EXPECT_THAT([&] { parse_gate(text); }, ThrowsMessage<std::runtime_error>(HasSubstr("--gate: expected")))
        << text;
}

}  // namespace
}  // namespace stereobench::harness
