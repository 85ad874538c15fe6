#include "harness/statistics/statistics.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

// Printed tables of Student's distribution. Mutation: exchanging the series of odd and even degrees.
TEST(StudentT, AgreesWithPrintedTables) {
  const std::vector<std::pair<long, double>> table = {
      {1, 12.706205}, {2, 4.302653},  {3, 3.182446},  {4, 2.776445},  {5, 2.570582},
      {9, 2.262157},  {10, 2.228139}, {30, 2.042272}, {99, 1.984217}, {1000, 1.962339}};
  for (const auto& [degrees, bound] : table) EXPECT_NEAR(student_t_95(degrees), bound, 1e-6) << degrees;
  EXPECT_NEAR(student_t_bound(0.99, 9), 3.249836, 1e-6);
  EXPECT_NEAR(student_t_bound(0.9999, 1), 6366.19767, 1e-4);
}

TEST(StudentT, IsCauchyForOneDegreeAndClosedForTwo) {
  for (const double t : {0.0, 0.3, 1.0, 7.0}) {
    EXPECT_NEAR(student_t_two_sided(t, 1), 2.0 / M_PI * std::atan(t), 1e-14);
    EXPECT_NEAR(student_t_two_sided(t, 2), t / std::sqrt(2.0 + t * t), 1e-14);
  }
  EXPECT_THROW(student_t_two_sided(-1.0, 1), std::invalid_argument);
  EXPECT_THROW(student_t_two_sided(1.0, 0), std::invalid_argument);
}

TEST(Summarise, ByHand) {
  const std::vector<double> values = {1.0, 2.0, 6.0};
  const Summary summary = summarise(values);
  EXPECT_DOUBLE_EQ(summary.mean, 3.0);
  EXPECT_DOUBLE_EQ(summary.sd, std::sqrt(7.0));
  EXPECT_DOUBLE_EQ(summary.max, 6.0);
  EXPECT_NEAR(summary.half_width, 4.302653 * std::sqrt(7.0 / 3.0), 1e-5);
  EXPECT_EQ(summary.count, 3);
}

TEST(Summarise, LeavesOutWhatIsNotFiniteAndSaysSo) {
  const double nan = std::nan("");
  const std::vector<double> values = {nan, -2.0, std::numeric_limits<double>::infinity()};
  const Summary summary = summarise(values);
  EXPECT_EQ(summary.count, 1);
  EXPECT_DOUBLE_EQ(summary.mean, -2.0);
  EXPECT_DOUBLE_EQ(summary.max, -2.0);
  EXPECT_DOUBLE_EQ(summary.sd, 0.0);
  EXPECT_TRUE(std::isinf(summary.half_width));
  EXPECT_EQ(summarise({}).count, 0);
  EXPECT_TRUE(std::isnan(summarise({}).mean));
}

// 4,000 samples of 5 normals: the interval holds the mean in 95 % of them, to 4 binomial deviations (1.4 %).
// Mutation: 1.96 in place of Student's bound holds it in 88 %.
TEST(Summarise, TheIntervalHoldsTheMeanAsOftenAsItSays) {
  slam::RandomStream random(7, slam::Stream::kWorld);
  int held = 0;
  for (int sample = 0; sample < 4000; ++sample) {
    std::vector<double> values(5);
    for (double& value : values) value = 3.0 + random.normal();
    const Summary summary = summarise(values);
    held += std::abs(summary.mean - 3.0) <= summary.half_width ? 1 : 0;
  }
  EXPECT_NEAR(held / 4000.0, 0.95, 0.014);
}

}  // namespace
}  // namespace stereobench::harness
