// What FastSlam adds to its parts: weights over frames, resampling that keeps together a path's end, its map
// and what was decided of the frame, and what becomes of new balls.
#include "slam/fast_slam.h"

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

template <class Model>
class FastSlams : public ::testing::Test {
 protected:
  static constexpr double kWay_sd_m = 0.2;

  // A filter that saw a landmark ahead, and then drove towards it over a way that is poorly known.
  static FastSlam<Model> after_a_way(FilterConfig config, const RangeBearing& ahead, std::uint64_t seed) {
    config.odometry_noise.v_constant_mps = kWay_sd_m;
    FastSlam<Model> filter(config, {}, seed);
    filter.update(std::vector<RangeBearing>{ahead});
    filter.predict({1.0, 0.0, 1.0});
    return filter;
  }
};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(FastSlams, BothModels);

RangeBearing known(double range_m, double range_sd_m, int landmark_id) {
  RangeBearing seen = sighting({range_m, 0.0}, range_sd_m, 0.01);
  seen.landmark_id = landmark_id;
  return seen;
}

// The way is drawn when a second landmark is found, weighed when the first is seen again, and known from then
// on: what was found before the particles were resampled and what is found after it are as uncertain as the
// fused way. Catches ancestors that are not followed, a map or a posterior that is not copied, and weights
// that count twice.
TYPED_TEST(FastSlams, ResamplingKeepsPathsAndTheirMaps) {
  constexpr int kParticles = 6000;
  FastSlam<TypeParam> filter =
      this->after_a_way({.particles = kParticles, .resample_below = 1.0}, known(3.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
  filter.update(std::vector<RangeBearing>{known(2.0, 0.05, 1)});
  filter.update(std::vector<RangeBearing>{known(5.0, 1e-3, 3)});
  const Estimate after = filter.estimate();
  EXPECT_GE(after.counters.resamplings, 1);
  const double way_m2 = this->kWay_sd_m * this->kWay_sd_m;
  const double sightings_m2 = 2.0 * 0.05 * 0.05;  // found and seen again
  const double fused_m2 = way_m2 * sightings_m2 / (way_m2 + sightings_m2);
  const double distinct = kParticles * std::sqrt(fused_m2 / way_m2);
  ASSERT_EQ(after.landmarks.size(), 3u);
  for (const std::size_t found : {1u, 2u}) {
    EXPECT_NEAR(after.landmarks[found].covariance(0, 0) / fused_m2, 1.0, 5.0 * std::sqrt(2.0 / distinct))
        << "landmark " << after.landmarks[found].landmark_id;
  }
}

// Most particles are so far off that they take the ball for a new one, and those that recognise it outweigh
// them. Catches copies that carry on with what the particle they replace had decided.
TYPED_TEST(FastSlams, ResamplingTakesDecisionsAlong) {
  constexpr int kSeeds = 16;
  int doubled = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RangeBearing ball = sighting({3.0, 0.0}, 0.01, 0.01);
    ball.colour_class = 4;
    FastSlam<TypeParam> filter = this->after_a_way({.particles = 300, .resample_below = 1.0}, ball, seed);
    filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
    ball.range_m = 2.0;
    filter.update(std::vector<RangeBearing>{ball});
    doubled += filter.estimate().landmarks.size() == 2u ? 0 : 1;
  }
  EXPECT_LE(doubled, 2);
}

// Four more looks at the first landmark, no resampling: the way is known as after all of them. Catches
// weights of earlier frames that are forgotten.
TYPED_TEST(FastSlams, WeightsAreAProductOverFrames) {
  constexpr int kParticles = 6000;
  FastSlam<TypeParam> filter =
      this->after_a_way({.particles = kParticles, .resample_below = 0.0}, known(3.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
  for (int look = 0; look < 4; ++look) filter.update(std::vector<RangeBearing>{known(2.0, 0.05, 1)});
  const double way_m2 = this->kWay_sd_m * this->kWay_sd_m;
  const double sightings_m2 = 0.05 * 0.05 * (1.0 + 1.0 / 4.0);
  const double fused_m2 = way_m2 * sightings_m2 / (way_m2 + sightings_m2);
  const double distinct = kParticles * std::sqrt(fused_m2 / way_m2);
  const Estimate after = filter.estimate();
  EXPECT_EQ(after.counters.resamplings, 0);
  EXPECT_NEAR(after.landmarks.at(1).covariance(0, 0) / fused_m2, 1.0, 5.0 * std::sqrt(2.0 / distinct));
}

// Catches particles that are drawn or weighed after a frame that none of them believed.
TYPED_TEST(FastSlams, AFrameThatNobodyBelievesIsNoFrame) {
  FastSlam<TypeParam> filter = this->after_a_way({.particles = 20}, known(3.0, 0.05, 1), 1);
  FastSlam<TypeParam> puzzled = filter;
  puzzled.update(std::vector<RangeBearing>{known(9.0, 0.05, 1)});
  EXPECT_EQ(puzzled.estimate().counters.gated_measurements, 20);
  for (FastSlam<TypeParam>* each : {&filter, &puzzled})
    each->update(std::vector<RangeBearing>{known(2.0, 0.05, 1), known(4.0, 0.05, 2)});
  const Estimate a = filter.estimate();
  const Estimate b = puzzled.estimate();
  EXPECT_TRUE(near(a.pose, b.pose, 0.0));
  for (const std::size_t i : {0u, 1u})
    EXPECT_TRUE(near(a.landmarks.at(i).position_m, b.landmarks.at(i).position_m, 0.0));
}

// Catches the noise of the sensor taken at its word.
TYPED_TEST(FastSlams, NoSensorIsBetterThanTheFloor) {
  FastSlam<TypeParam> filter({.particles = 3, .range_floor_m = 0.02, .bearing_floor_rad = 0.01}, {}, 1);
  filter.update(std::vector<RangeBearing>{known(4.0, 0.0, 1)});
  const Eigen::Matrix2d covariance = filter.estimate().landmarks.at(0).covariance;
  EXPECT_NEAR(covariance(0, 0), 0.02 * 0.02, 1e-6);
  EXPECT_GE(covariance(1, 1), 0.99 * 16.0 * 1e-4);
}

RangeBearing ball_of(int colour, double range_m) {
  RangeBearing seen = sighting({range_m, 0.0}, 1e-3, 0.01);
  seen.colour_class = colour;
  return seen;
}

// Catches a check for doubles that is left out, and one that does not ask for the colour.
TYPED_TEST(FastSlams, TwoNewBallsOfAColourWithinHalfItsSpacingAreOne) {
  for (const int other : {4, 5}) {
    FastSlam<TypeParam> filter({.particles = 3, .colour_spacing_m = 10.0}, {}, 1);
    filter.update(std::vector<RangeBearing>{ball_of(4, 3.0), ball_of(other, 4.0)});
    EXPECT_EQ(filter.estimate().landmarks.size(), other == 4 ? 1u : 2u);
    EXPECT_EQ(filter.estimate().counters.gated_measurements, other == 4 ? 3 : 0);
  }
}

// Two balls that are nearer to each other than each is known. Catches particles whose balls are mixed by
// nearness alone.
TYPED_TEST(FastSlams, BallsAreMixedWithTheirOwnColourOnly) {
  FastSlam<TypeParam> filter =
      this->after_a_way({.particles = 6000, .colour_spacing_m = 10.0}, known(9.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{ball_of(4, 3.0), ball_of(5, 3.2)});
  const Estimate after = filter.estimate();
  ASSERT_EQ(after.landmarks.size(), 3u);
  for (const std::size_t i : {1u, 2u}) {
    const double way_m2 = this->kWay_sd_m * this->kWay_sd_m;
    EXPECT_NEAR(after.landmarks[i].covariance(0, 0) / way_m2, 1.0, 5.0 * std::sqrt(2.0 / 6000.0));
  }
}

}  // namespace
}  // namespace stereobench::slam
