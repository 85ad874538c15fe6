#include "slam/math/random.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace stereobench::slam {
namespace {

// The generator's published known-answer vectors: catches words in the wrong order and a wrong number of
// rounds.
TEST(RandomStream, GivesPhilox4x32KnownAnswers) {
  RandomStream zero(0, Stream::kWorld, 0);
  EXPECT_EQ(zero.bits(), 0x6627e8d5u);
  EXPECT_EQ(zero.bits(), 0xe169c58du);
  EXPECT_EQ(zero.bits(), 0xbc57ac4cu);
  EXPECT_EQ(zero.bits(), 0x9b00dbd8u);
}

TEST(RandomStream, SameKeySameNumbers) {
  RandomStream a(7, Stream::kFilter, 3);
  RandomStream b(7, Stream::kFilter, 3);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(a.normal(), b.normal());
}

// Catches a key part that is dropped: seed, stream or index, in their low or high words.
TEST(RandomStream, EveryPartOfTheKeyMatters) {
  std::set<std::uint32_t> first_words;
  const std::uint64_t high = std::uint64_t{1} << 40;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, high}) {
    for (const Stream stream : {Stream::kWorld, Stream::kOdometry, Stream::kFilter}) {
      for (const std::uint64_t index : {std::uint64_t{0}, std::uint64_t{1}, high}) {
        first_words.insert(RandomStream(seed, stream, index).bits());
      }
    }
  }
  EXPECT_EQ(first_words.size(), 27u);
}

TEST(RandomStream, UniformIsInRangeWithTheRightMoments) {
  RandomStream random(1, Stream::kWorld);
  constexpr int kDraws = 200000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_TRUE(u >= 0.0 && u < 1.0);
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / kDraws));
}

// Five standard errors each. Catches uniform noise in place of Gaussian: its fourth moment is 1.8, not 3.
TEST(RandomStream, NormalHasTheMomentsOfAGaussian) {
  RandomStream random(2, Stream::kFilter);
  constexpr int kDraws = 400000;
  double moments[5] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    for (int power = 1; power <= 4; ++power) moments[power] += std::pow(x, power) / kDraws;
  }
  EXPECT_NEAR(moments[1], 0.0, 5.0 * std::sqrt(1.0 / kDraws));
  EXPECT_NEAR(moments[2], 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(moments[3], 0.0, 5.0 * std::sqrt(15.0 / kDraws));
  EXPECT_NEAR(moments[4], 3.0, 5.0 * std::sqrt(96.0 / kDraws));
}

// Against the C library's erfc, an independent route. Catches any wrong digit in the 48 coefficients.
TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (double p = 1e-300; p < 0.5; p *= 1.7) {
    const double x = normal_quantile(p);
    const double back = 0.5 * std::erfc(-x / std::sqrt(2.0));
    ASSERT_NEAR(back / p, 1.0, 1e-14 * (1.0 + x * x)) << "p " << p;
  }
  for (double p = 0.01; p < 0.5; p += 0.001)
    ASSERT_NEAR(normal_quantile(p), -normal_quantile(1.0 - p), 1e-12);
  EXPECT_EQ(normal_quantile(0.5), 0.0);
}

}  // namespace
}  // namespace stereobench::slam
