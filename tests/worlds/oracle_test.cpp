// The sensor without pixels: what is in view, how it is labelled, and how its noise is spread.
#include "worlds/oracle.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/angles.h"
#include "slam/models/motion.h"

namespace stereobench::worlds {
namespace {

World world_of(const std::vector<Eigen::Vector2d>& places_m) {
  World world;
  for (const Eigen::Vector2d& place_m : places_m) {
    world.balls.push_back({{place_m.x(), place_m.y(), 0.5}, 0.1, static_cast<int>(world.balls.size()) + 3});
  }
  return world;
}

std::vector<int> ids_in_view(const World& world, const slam::Pose& pose, const OracleSensor& sensor) {
  slam::RandomStream noise(1, slam::Stream::kOracle);
  std::vector<int> ids;
  for (const auto& sighting : sense(world, pose, sensor, Identity::kKnown, noise).measurements)
    ids.push_back(sighting.landmark_id);
  return ids;
}

// Catches: eq. 5's swapped atan2, a heading added instead of taken off, a bearing that is not wrapped.
TEST(Oracle, WithoutNoiseMeasuresRangeAndLeftPositiveBearing) {
  const World world = world_of({{-3, 1}, {-2, -4}});
  slam::RandomStream noise(0, slam::Stream::kOracle);
  const auto seen =
      sense(world, {-2, 1, slam::kPi - 0.1}, {0, 0, 30, 2 * slam::kPi}, Identity::kKnown, noise).measurements;
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_NEAR(seen[0].range_m, 1.0, 1e-15);
  EXPECT_NEAR(seen[0].bearing_rad, 0.1, 1e-15);
  EXPECT_NEAR(seen[1].range_m, 5.0, 1e-15);
  EXPECT_NEAR(seen[1].bearing_rad, slam::kPi / 2 + 0.1, 1e-15);
}

// Catches: the whole angle taken for the half, a range limit that is left out.
TEST(Oracle, SeesTheSectorOnly) {
  const World world = world_of({{9.9, 0}, {10.1, 0}, {1, 0.99}, {1, 1.01}, {1, -0.99}, {1, -1.01}, {-1, 0}});
  const OracleSensor quarter = {0.01, 0.01, 10, slam::kPi / 2};
  EXPECT_THAT(ids_in_view(world, {}, quarter), testing::ElementsAre(0, 2, 4));
  EXPECT_THAT(ids_in_view(world, {0, 0, slam::kPi}, quarter), testing::ElementsAre(6));
  EXPECT_THAT(ids_in_view(world, {100, 100, 0}, quarter), testing::IsEmpty());
}

TEST(Oracle, GivesIdentityOrColourNeverBoth) {
  const World world = world_of({{1, 0}, {2, 0}});
  slam::RandomStream noise(0, slam::Stream::kOracle);
  const auto known = sense(world, {}, OracleSensor{}, Identity::kKnown, noise).measurements;
  EXPECT_EQ(known.at(1).landmark_id, 1);
  EXPECT_EQ(known.at(1).colour_class, slam::kUnknown);
  const auto coloured = sense(world, {}, OracleSensor{}, Identity::kColourClass, noise).measurements;
  EXPECT_EQ(coloured.at(1).landmark_id, slam::kUnknown);
  EXPECT_EQ(coloured.at(1).colour_class, 4);
}

TEST(Oracle, NeverGivesANegativeRangeAndIsTheSameAgain) {
  const World world = world_of({{0.05, 0}, {0.1, 0.02}, {0.3, 0}});
  int kept = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    slam::RandomStream noise(seed, slam::Stream::kOracle), again(seed, slam::Stream::kOracle);
    const auto seen = sense(world, {}, OracleSensor{}, Identity::kKnown, noise).measurements;
    const auto seen_again = sense(world, {}, OracleSensor{}, Identity::kKnown, again).measurements;
    ASSERT_EQ(seen.size(), seen_again.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_TRUE(seen[i].range_m >= 0.0);
      EXPECT_EQ(seen[i].range_m, seen_again[i].range_m);
      EXPECT_EQ(seen[i].bearing_rad, seen_again[i].bearing_rad);
      ++kept;
    }
  }
  EXPECT_GT(kept, 200);
  EXPECT_LT(kept, 600) << "some must have been refused";
}

// Catches: variance taken for deviation, noise shared by range and bearing, a covariance that is not the
// noise's. n draws: the mean's sd is sigma / sqrt(n), the variance's sigma^2 sqrt(2 / n), the correlation's 1
// / sqrt(n).
TEST(Oracle, NoiseHasTheSpreadThatTheCovarianceSays) {
  const World world = world_of({{20, 5}});
  const OracleSensor sensor = {0.3, 3 * slam::kPi / 180, 30, slam::kPi};
  constexpr int kDraws = 20000;
  slam::RandomStream noise(42, slam::Stream::kOracle);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const auto seen = sense(world, {}, sensor, Identity::kKnown, noise).measurements;
    const Eigen::Vector2d sd = seen.at(0).covariance.diagonal().cwiseSqrt();
    ASSERT_NEAR(sd.x(), 0.3, 1e-12);
    ASSERT_EQ(seen[0].covariance(0, 1), 0.0);
    const Eigen::Vector2d error = {(seen[0].range_m - std::hypot(20, 5)) / sd.x(),
                                   (seen[0].bearing_rad - std::atan2(5, 20)) / sd.y()};
    sum += error;
    squares += error * error.transpose();
  }
  EXPECT_TRUE((sum / kDraws).cwiseAbs().maxCoeff() < 4 / std::sqrt(kDraws));
  EXPECT_NEAR(squares(0, 0) / kDraws, 1.0, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(squares(1, 1) / kDraws, 1.0, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(squares(0, 1) / kDraws, 0.0, 4 / std::sqrt(kDraws));
}

// Without identities a sighting says nothing but where; the truth beside it does not change.
TEST(Oracle, KeepsWhoseEachSightingIsApart) {
  const World world = world_of({{50, 0}, {2, 0}, {3, 1}});
  for (const Identity identity : {Identity::kKnown, Identity::kColourClass, Identity::kNone}) {
    slam::RandomStream noise(0, slam::Stream::kOracle);
    const Sightings look = sense(world, {}, OracleSensor{}, identity, noise);
    EXPECT_THAT(look.balls, testing::ElementsAre(1, 2));
    ASSERT_EQ(look.measurements.size(), 2U);
    EXPECT_EQ(look.measurements[0].landmark_id, identity == Identity::kKnown ? 1 : slam::kUnknown);
    EXPECT_EQ(look.measurements[0].colour_class, identity == Identity::kColourClass ? 4 : slam::kUnknown);
  }
}

// Mutation: a draw that is taken where nothing can go wrong.
TEST(OracleFaults, AreNoneByDefaultAndDrawNothing) {
  const World world = world_of({{2, 0}, {3, 1}});
  slam::RandomStream noise(0, slam::Stream::kOracle);
  slam::RandomStream chance(0, slam::Stream::kClutter), untouched(0, slam::Stream::kClutter);
  const Sightings all = sense(world, {}, OracleSensor{}, Identity::kNone, noise);
  const Sightings same = with_faults(all, world, OracleSensor{}, Identity::kNone, chance);
  EXPECT_EQ(same.balls, all.balls);
  EXPECT_EQ(same.measurements.at(1).range_m, all.measurements.at(1).range_m);
  EXPECT_EQ(chance.bits(), untouched.bits());
}

// A count of mean m in n looks has a deviation of sqrt(m / n). Mutations: a Poisson variable that is
// one too large, ranges that are uniform, half the sector's angle, misses that hit the false ones, too.
TEST(OracleFaults, HappenAsOftenAndWhereTheyShould) {
  const World world = world_of({{2, 0}, {3, 1}});
  OracleSensor sensor;
  sensor.miss_probability = 0.2;
  sensor.false_per_look = 1.5;
  constexpr int kLooks = 20000;
  slam::RandomStream noise(7, slam::Stream::kOracle), chance(7, slam::Stream::kClutter);
  double seen = 0.0, imagined = 0.0, squares = 0.0, near = 0.0, left = 0.0, outer_left = 0.0;
  for (int i = 0; i < kLooks; ++i) {
    const Sightings all = sense(world, {}, sensor, Identity::kNone, noise);
    const Sightings look = with_faults(all, world, sensor, Identity::kNone, chance);
    double here = 0.0;
    for (std::size_t k = 0; k < look.balls.size(); ++k) {
      if (look.balls[k] != slam::kUnknown) {
        ++seen;
        continue;
      }
      const slam::RangeBearing& sighting = look.measurements[k];
      ASSERT_LE(sighting.range_m, sensor.max_range_m);
      ASSERT_LE(std::abs(sighting.bearing_rad), slam::kPi / 2 + 1e-9);
      ++here;
      near += sighting.range_m < sensor.max_range_m / 2 ? 1 : 0;
      left += sighting.bearing_rad > 0 ? 1 : 0;
      outer_left += sighting.bearing_rad > slam::kPi / 4 ? 1 : 0;
    }
    imagined += here;
    squares += here * here;
  }
  const double mean = imagined / kLooks;
  EXPECT_NEAR(seen / kLooks, 1.6, 4 * std::sqrt(2 * 0.16 / kLooks));
  EXPECT_NEAR(mean, 1.5, 4 * std::sqrt(1.5 / kLooks));
  EXPECT_NEAR(squares / kLooks - mean * mean, 1.5, 4 * std::sqrt((1.5 + 2 * 1.5 * 1.5) / kLooks));
  const double spread = 4 * 0.5 / std::sqrt(imagined);
  EXPECT_NEAR(near / imagined, 0.25, spread) << "a quarter of the area";
  EXPECT_NEAR(left / imagined, 0.5, spread);
  EXPECT_NEAR(outer_left / imagined, 0.25, spread);
}

// Mutation: a colour that no ball has.
TEST(OracleFaults, LookLikeTheOthers) {
  const World world = world_of({{2, 0}, {3, 1}});
  OracleSensor sensor;
  sensor.false_per_look = 5.0;
  for (const Identity identity : {Identity::kKnown, Identity::kColourClass, Identity::kNone}) {
    slam::RandomStream chance(1, slam::Stream::kClutter);
    const Sightings look = with_faults({}, world, sensor, identity, chance);
    ASSERT_FALSE(look.measurements.empty());
    for (const slam::RangeBearing& sighting : look.measurements) {
      EXPECT_EQ(sighting.landmark_id, slam::kUnknown);
      if (identity == Identity::kColourClass) {
        EXPECT_THAT(sighting.colour_class, testing::AnyOf(3, 4));
      } else {
        EXPECT_EQ(sighting.colour_class, slam::kUnknown);
      }
      EXPECT_DOUBLE_EQ(sighting.covariance(0, 0), sensor.range_sd_m * sensor.range_sd_m);
    }
  }
}

}  // namespace
}  // namespace stereobench::worlds
