#include "harness/sensitivity/sensitivity_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/json/json_text.h"
#include "tests/harness/sensitivity/known_functions.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Two keys of which the second matters most and acts with chance; four numbers tell each index apart.
Sensitivity small_study() {
  Sensitivity study{.scenario = "open_field",
                    .metric = "filters.smoother.ate_rms_m",
                    .factors = {.keys = {{"oracle.range_sd_m", 0.1, 0.3, Spacing::kEven},
                                         {"particles", 10.0, 100.0, Spacing::kLogarithmic}},
                                .streams = {"seed"}},
                    .settings = {.samples = 128, .level = 0.9, .seed = 7},
                    .indices = {.mean = 0.5, .sd = 0.25, .rows = 126, .rows_left_out = 2, .failed_runs = 3}};
  study.indices.factors = {{{-0.0125, {-0.1, 0.05}}, {0.0625, {0.03, 0.09}}, {0.075, {-0.01, 0.16}}},
                           {{0.5, {0.4, 0.6}}, {0.75, {0.65, 0.85}}, {0.25, {0.15, 0.35}}},
                           {{0.125, {0.1, 0.15}}, {0.3125, {0.25, 0.375}}, {0.1875, {0.125, 0.25}}}};
  return study;
}

// Mutation: the smallest first.
TEST(SensitivityTable, HasTheLargestTotalFirst) {
  EXPECT_EQ(sensitivity_table(small_study()),
            "factor                             values   first    90 % interval  total   90 % interval\n"
            "-----------------  ----------------------  ------  ---------------  -----  --------------\n"
            "particles          10 to 100, logarithmic   0.500   0.400 to 0.600  0.750  0.650 to 0.850\n"
            "seed                       random numbers   0.125   0.100 to 0.150  0.312  0.250 to 0.375\n"
            "oracle.range_sd_m              0.1 to 0.3  -0.013  -0.100 to 0.050  0.062  0.030 to 0.090\n");
}

// Mutations: chance by its first index; interactions where the interval reaches below 0; twice the samples.
TEST(SensitivityRemarks, SayWhatIsToBeKnown) {
  EXPECT_THAT(
      sensitivity_remarks(small_study()),
      ElementsAre(
          StartsWith("first: the share of the variance"),
          "Chance: where every key is known, 0.312 (0.250 to 0.375) of the variance is left: the total "
          "index of seed.",
          "particles acts together with other factors: total less first is 0.250 (0.150 to 0.350).",
          "seed acts together with other factors: total less first is 0.188 (0.125 to 0.250).",
          "First index not told from 0: oracle.range_sd_m. A number below 0 is a sampling error. "
          "--samples 512 would halve the intervals.",
          "3 runs gave no value. The 2 rows of 128 with one of them are left out: the indices are of the "
          "rest, in which all runs ended well."));
}

TEST(SensitivityRemarks, AreFewWhereThereIsNothingToSay) {
  const Sensitivity study = study_of(product(), {.samples = 512});
  for (const std::string& remark : sensitivity_remarks(study)) {
    EXPECT_THAT(remark, Not(HasSubstr("Chance")));
    EXPECT_THAT(remark, Not(HasSubstr("not told")));
    EXPECT_THAT(remark, Not(HasSubstr("no value")));
  }
  const auto streams = sensitivity_remarks(study_of(four_streams(), {.samples = 512}));
  for (const std::string& remark : streams) EXPECT_THAT(remark, Not(HasSubstr("Chance")));
}

// What does nothing to the bit needs no more samples.
TEST(SensitivityRemarks, DoNotAskForSamplesWhereNothingIsUnsure) {
  KnownFunction function = product();
  function.value = [](const StudyPoint& point) { return point.values[0]; };
  EXPECT_EQ(sensitivity_remarks(study_of(function, {.samples = 64})).size(), 1u);
}

TEST(SensitivityRemarks, SayWhyThereAreNoIndices) {
  KnownFunction function = product();
  function.value = [](const StudyPoint&) { return 2.0; };
  EXPECT_EQ(sensitivity_remarks(study_of(function, {.samples = 64})).at(1),
            "The metric is the same in all runs: there is no variance to share.");
  function.value = [](const StudyPoint&) { return std::nan(""); };
  const Sensitivity failed = study_of(function, {.samples = 64});
  EXPECT_EQ(sensitivity_remarks(failed).at(1), "Too few rows are left: 10 are needed.");
  EXPECT_THAT(sensitivity_text(failed), HasSubstr("mean -, sd -, over 256 runs"));
  EXPECT_EQ(sensitivity_json(failed)["factors"][0]["first"]["value"], nullptr);
}

TEST(SensitivityJson, HasWhatTheStudyIsMadeOf) {
  const nlohmann::ordered_json json = sensitivity_json(small_study());
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["metric"], "filters.smoother.ate_rms_m");
  EXPECT_EQ(json["samples"], 128);
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["interval"], 0.9);
  EXPECT_EQ(json["runs"], 5 * 128);
  EXPECT_EQ(json["failed_runs"], 3);
  EXPECT_EQ(json["rows"], 126);
  EXPECT_EQ(json["rows_left_out"], 2);
  EXPECT_EQ(json["mean"], 0.5);
  EXPECT_EQ(json["sd"], 0.25);
  EXPECT_EQ(json["factors"][0].dump(), R"({"key":"oracle.range_sd_m","low":0.1,"high":0.3,)"
                                       R"("first":{"value":-0.0125,"low":-0.1,"high":0.05},)"
                                       R"("total":{"value":0.0625,"low":0.03,"high":0.09},)"
                                       R"("interactions":{"value":0.075,"low":-0.01,"high":0.16}})");
  EXPECT_EQ(json["factors"][1]["spacing"], "log");
  EXPECT_EQ(json["factors"][2]["stream"], "seed");
}

TEST(SensitivityJson, IsTheSameBytesTwice) {
  const auto text = [](std::uint64_t seed) {
    return json_text(
        sensitivity_json(study_of(sum_with_chance(), {.samples = 64, .level = 0.95, .seed = seed})));
  };
  EXPECT_EQ(text(3), text(3));
  EXPECT_NE(text(3), text(4));
}

std::string refusal_of_settings(const StudySettings& settings) {
  try {
    study_of(product(), settings);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StudySensitivity, RefusesInOneLine) {
  EXPECT_EQ(refusal_of_settings({.samples = 15}), "--samples: expected 16 to 1000000, got 15");
  EXPECT_EQ(refusal_of_settings({.samples = 16, .level = 0.999}),
            "--interval: expected 0.5 to 0.99, got 0.999");
  EXPECT_EQ(refusal_of_settings({.samples = 16, .level = std::nan("")}),
            "--interval: expected 0.5 to 0.99, got nan");
  EXPECT_EQ(refusal_of_settings({.samples = 16}), "accepted");
  EXPECT_THROW(study_sensitivity(product().factors, {.samples = 16},
                                 [](const auto&) { return std::vector<double>(63); }),
               std::invalid_argument);
}

// A study costs what it says, in one call: a batch can be run in parallel.
TEST(StudySensitivity, AsksForAllPointsAtOnce) {
  const KnownFunction function = sum_with_chance();
  std::vector<std::size_t> asked;
  study_sensitivity(function.factors, {.samples = 32}, [&](const std::vector<StudyPoint>& points) {
    asked.push_back(points.size());
    return evaluate(function, points);
  });
  EXPECT_THAT(asked, ElementsAre(32u * (3u + 2u)));
  EXPECT_EQ(count_of_points(function.factors, 32), 32u * (3u + 2u));
}

TEST(OrderByTotal, HasWhatHasNoneLast) {
  SobolIndices indices;
  indices.factors.resize(4);
  indices.factors[1].total.value = 0.25;
  indices.factors[2].total.value = 0.75;
  indices.factors[3].total.value = 0.25;
  EXPECT_THAT(order_by_total(indices), ElementsAre(2u, 1u, 3u, 0u));
}

}  // namespace
}  // namespace stereobench::harness
