/// Verdicts by steps: how many seeds, what they may risk, and what they decide.
#include "harness/suite/looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

TEST(Looks, DoubleUpToTheMost) {
  EXPECT_THAT(look_sizes(80), ElementsAre(10, 20, 40, 80));
  EXPECT_THAT(look_sizes(10), ElementsAre(10));
  EXPECT_THAT(look_sizes(3), ElementsAre(3));
  EXPECT_THAT(look_sizes(50), ElementsAre(10, 20, 40, 50));
}

// Mutation: looks that have the whole alpha each.
TEST(Looks, TogetherRiskWhatOneMay) {
  for (const std::size_t most : {10U, 40U, 80U}) {
    double risk = 0.0;
    for (std::size_t i = 0; i < look_sizes(most).size(); ++i)
      risk += alpha_of_look(0.01, look_sizes(most).size());
    EXPECT_NEAR(risk, 0.01, 1e-15);
  }
}

constexpr std::size_t kMost = 80;
constexpr double kMargin = 0.05;
const char* const kMetric = "filters.ekf.ate_rms_m";

/// Errors of 80 seeds whose logarithms spread by 0.44, and the same ones worse by `change`; pairs correlate
/// by 0.99, as those of a filter that is changed a little.
std::pair<std::vector<double>, std::vector<double>> errors(std::uint64_t number, double change) {
  slam::RandomStream random(number, slam::Stream::kResample);
  std::pair<std::vector<double>, std::vector<double>> pairs;
  for (std::size_t i = 0; i < kMost; ++i) {
    const double world = 0.44 * random.normal();
    pairs.first.push_back(slam::exponential(world));
    pairs.second.push_back((1.0 + change) * slam::exponential(world + 0.06 * random.normal()));
  }
  return pairs;
}

SeedTable table_of(const std::vector<double>& values, std::size_t seeds) {
  SeedTable table;
  for (std::size_t i = 0; i < seeds; ++i) table.seeds.push_back(i);
  table.metrics[kMetric].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(seeds));
  return table;
}

struct Course {
  std::size_t seeds = 0;  ///< of the last look
  Verdict verdict = Verdict::kPass;
};

Course look_at(const std::pair<std::vector<double>, std::vector<double>>& pairs) {
  const std::vector<std::size_t> sizes = look_sizes(kMost);
  for (const std::size_t seeds : sizes) {
    const ResultComparison comparison =
        compare_results(table_of(pairs.first, seeds), table_of(pairs.second, seeds),
                        {.alpha = alpha_of_look(0.01, sizes.size()),
                         .margins = {{.pattern = kMetric, .relative = true, .value = kMargin}}});
    if (is_decided(comparison) || seeds == sizes.back()) return {seeds, comparison.metrics.front().verdict};
  }
  return {};
}

struct Courses {
  int regressed = 0, passed = 0, inconclusive = 0;
  double mean_seeds = 0.0;
};

Courses courses_of(double change) {
  constexpr int kStudies = 50;
  Courses courses;
  for (int i = 0; i < kStudies; ++i) {
    const Course course = look_at(errors(static_cast<std::uint64_t>(i), change));
    courses.regressed += course.verdict == Verdict::kRegressed ? 1 : 0;
    courses.passed += course.verdict == Verdict::kPass ? 1 : 0;
    courses.inconclusive += course.verdict == Verdict::kInconclusive ? 1 : 0;
    courses.mean_seeds += static_cast<double>(course.seeds) / kStudies;
  }
  return courses;
}

// A change of exactly the margin is on neither side of it: all looks together call it REGRESSED or PASS in 1
// % each at most, and of 100 studies at most 5 by chance (probability 0.0005 of more). Mutations: looks that
// have the whole alpha each; a margin that the middle of the interval is held against.
TEST(Looks, OfAChangeOfTheMarginEndUndecidedAtTheMost) {
  const Courses courses = courses_of(kMargin);
  EXPECT_LE(courses.regressed + courses.passed, 5);
  EXPECT_GE(courses.mean_seeds, 76.0);
}

// Mutation: a look that is never the last.
TEST(Looks, DecideWithFewerSeedsThanAFixedNumber) {
  const Courses none = courses_of(0.0);
  EXPECT_GE(none.passed, 49);
  EXPECT_LT(none.mean_seeds, 60.0);
  const Courses twice = courses_of(2.0 * kMargin);
  EXPECT_GE(twice.regressed, 49);
  EXPECT_LT(twice.mean_seeds, 60.0);
}

}  // namespace
}  // namespace stereobench::harness
