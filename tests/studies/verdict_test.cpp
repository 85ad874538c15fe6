// What a study says of its measurements.
#include "tests/studies/verdict.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/studies/depth_study.h"

namespace stereobench {
namespace {

Verdict verdict_at(double measured, const Limit& limit) {
  return verdict_of({"", measured, 0.0, limit});
}

// Ends belong to what is allowed, and nothing measured meets no limit.
// Mutations: the lower end left out; short only of what is known to be beyond (NaN meets).
TEST(Verdict, IsMetWithinTheLimitAlone) {
  const Limit range = {0.9, 1.1};
  for (const double inside : {0.9, 1.0, 1.1}) EXPECT_EQ(verdict_at(inside, range), Verdict::kMet) << inside;
  for (const double outside : {0.89, 1.11, -1.0, std::nan("")})
    EXPECT_EQ(verdict_at(outside, range), Verdict::kShort) << outside;
  EXPECT_EQ(verdict_at(-5.0, {.at_most = 0.1}), Verdict::kMet);
  EXPECT_EQ(verdict_at(0.98, {.at_least = 0.99}), Verdict::kShort);
  EXPECT_EQ(verdict_at(std::nan(""), {}), Verdict::kNoLimit);
}

// Mutation: the last section alone.
TEST(Verdict, OfAStudyIsThatOfEveryLine) {
  const Section met = {"met", {{"a", 1.0}, {"b", 1.0, 0.0, {.at_most = 2.0}}}};
  const Section falls_short = {"short",
                               {{"c", 3.0, 0.0, {.at_most = 2.0}}, {"d", 1.0, 0.0, {.at_most = 2.0}}}};
  EXPECT_TRUE(all_met({met, met}));
  EXPECT_FALSE(all_met({falls_short, met}));
  EXPECT_FALSE(all_met({met, falls_short}));
}

TEST(Verdict, IsWrittenBesideWhatItIsOf) {
  const std::vector<Section> sections = {
      {"bias [px]", {{"near", -0.0004, 0.00025, {-0.003, 0.003}}, {"far", std::nan(""), 0.0, {0.9, 1.1}}}}};
  const std::string text = tables_of(sections);
  EXPECT_THAT(text, testing::ContainsRegex("near +-0.00040 \\+- 0.00025 +within 0.003 +met"));
  EXPECT_THAT(text, testing::ContainsRegex("far +- +0.9 .. 1.1 +short"));
  const nlohmann::ordered_json line = json_of(sections)[0]["lines"][1];
  EXPECT_TRUE(line["measured"].is_null());
  EXPECT_EQ(line["at_least"], 0.9);
  EXPECT_EQ(line["verdict"], "short");
}

/// The lines of a section.
std::vector<Line> lines_of(const std::vector<Section>& sections, const std::string& title) {
  for (const Section& section : sections)
    if (section.title == title) return section.lines;
  return {};
}

// Two depths whose disparities are off to either side, and parts of balls, which do not count; one ball is
// beyond the gate. Mutations: left and right radii summed for their mean; parts of balls among the lines;
// the refused ball's disparity counted.
TEST(DepthSections, HaveWhatTheSamplesOfEachDepthSay) {
  std::vector<harness::CalibrationSample> samples;
  for (int i = 0; i < 16; ++i) {
    harness::CalibrationSample sample;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const bool is_near = i % 4 < 2;
    sample.error = sign * Eigen::Vector2d(0.01, 1e-5);
    sample.stated = Eigen::Vector2d(1e-4, 1e-10).asDiagonal();
    sample.bounds.of_size = 0.25 * sample.stated;
    sample.disparity_error_px = (is_near ? 0.0005 : -0.004) + sign * 0.001;
    sample.radius_error_px = {0.03, -0.04};
    sample.depth_m = is_near ? 0.6 : 3.0;
    sample.whole = i < 12;
    samples.push_back(sample);
  }
  samples.push_back(samples.front());
  samples.back().error *= 100.0;
  samples.back().disparity_error_px = 1.0;
  const auto sections = depth_sections(harness::bin_samples(samples, {}, 0.5, 8.0, 2));
  const auto disparity = lines_of(sections, "disparity bias [px]");
  ASSERT_EQ(disparity.size(), 2U);
  EXPECT_EQ(disparity[0].what, "0.50 .. 2.00 m");
  EXPECT_NEAR(disparity[0].measured, 0.0005, 1e-12);
  EXPECT_NEAR(disparity[0].half_width, 2.5706 * 0.001 * std::sqrt(6.0 / 5.0) / std::sqrt(6.0), 1e-6);
  EXPECT_NEAR(disparity[1].measured, -0.004, 1e-12);
  EXPECT_EQ(verdict_of(disparity[0]), Verdict::kMet);
  EXPECT_EQ(verdict_of(disparity[1]), Verdict::kShort);
  EXPECT_NEAR(lines_of(sections, "error of fitted radii, rms [px]").at(0).measured, 0.05 / std::sqrt(2.0),
              1e-12);
  EXPECT_NEAR(lines_of(sections, "range sd / Cramer-Rao bound").at(1).measured, 2.0, 1e-12);
  EXPECT_NEAR(lines_of(sections, "bearing sd [mrad]").at(1).measured, 0.01 * std::sqrt(6.0 / 5.0), 1e-12);
  EXPECT_EQ(lines_of(sections, "share of these beyond the filters' gate, not counted below").at(0).measured,
            1.0 / 7.0);
}

}  // namespace
}  // namespace stereobench
