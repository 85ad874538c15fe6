// The log odds of landmarks: what speaks for them and against them.
#include "slam/association/existence.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

constexpr SensorSector kSector{20.0, 1.0, 0.1, 2.0};

Observation observed(double range_m, double bearing_rad) {
  return {{range_m, bearing_rad}, Eigen::Vector2d(0.1 * 0.1, 0.02 * 0.02).asDiagonal()};
}

// Mutations: any of the four that does not ask whether a sector is declared.
TEST(Existence, WithoutADeclaredSectorEverythingIsTakenForReal) {
  const Existence existence{SensorSector{}};
  EXPECT_FALSE(existence.is_tracked());
  EXPECT_TRUE(Existence::is_believed(existence.founded()));
  EXPECT_EQ(existence.unseen(existence.founded()), existence.founded());
  EXPECT_EQ(existence.seen(0.0F, observed(5.0, 0.0)), 0.0F);
  EXPECT_EQ(existence.cost_of_new(observed(5.0, 0.0)), INFINITY);
}

// Mutations: the sign of either kind of evidence.
TEST(Existence, SightingsSpeakForALandmarkAndLooksWithoutOneAgainstIt) {
  const Existence existence(kSector);
  EXPECT_FALSE(Existence::is_believed(existence.founded())) << "likelier clutter";
  const float twice = existence.seen(existence.founded(), observed(10.0, 0.0));
  EXPECT_TRUE(Existence::is_believed(existence.seen(twice, observed(10.0, 0.0))));
  EXPECT_TRUE(Existence::is_dead(existence.unseen(existence.unseen(existence.founded()))));
  float odds = existence.founded();
  for (int i = 0; i < 1000; ++i) odds = existence.seen(odds, observed(10.0, 0.0));
  int looks = 0;
  for (; looks < 100 && !Existence::is_dead(odds); ++looks) odds = existence.unseen(odds);
  EXPECT_GE(looks, 4) << "some misses in a row are normal";
  EXPECT_LE(looks, 10) << "what was seen a thousand times can go";
}

// Mutation: a floor alone under what may be missed, which forgets what is behind a corner.
TEST(Existence, WhatMayBeHiddenIsNotForgotten) {
  SensorSector sector = kSector;
  sector.miss_probability = 1.0;
  sector.false_per_look = 0.0;
  const Existence existence(sector);
  float odds = existence.founded();
  EXPECT_TRUE(Existence::is_believed(odds));
  for (int look = 0; look < 10000; ++look) odds = existence.unseen(odds);
  EXPECT_TRUE(Existence::is_believed(odds));
  EXPECT_EQ(existence.seen(odds, observed(5.0, 0.0)), odds);
}

// The better the sensor, the less can clutter pass for a landmark. Mutation: the clutter of the whole
// sector in place of that of the gate.
TEST(Existence, APreciseSightingSaysMore) {
  const Existence existence(kSector);
  Observation rough = observed(10.0, 0.0);
  rough.noise *= 25.0;
  EXPECT_GT(existence.seen(0.0F, observed(10.0, 0.0)), existence.seen(0.0F, rough));
  EXPECT_GE(existence.seen(0.0F, rough), 0.0F) << "a sighting never speaks against what it shows";
}

// Mutations: the whole angle for the half, the margin left out.
TEST(Existence, OnlyWhatIsSafelyWithinTheSectorIsMissed) {
  const Existence existence(kSector);
  const Pose robot{1.0, 2.0, 0.5};
  const auto at = [&](double range_m, double bearing_rad, double sd_m) {
    const LandmarkBelief there{locate(robot, {range_m, bearing_rad}),
                               sd_m * sd_m * Eigen::Matrix2d::Identity()};
    return existence.should_be_seen(robot, there);
  };
  EXPECT_TRUE(at(19.0, 0.95, 0.0));
  EXPECT_FALSE(at(20.1, 0.0, 0.0));
  EXPECT_FALSE(at(5.0, 1.05, 0.0));
  EXPECT_FALSE(at(5.0, -1.05, 0.0));
  EXPECT_FALSE(at(19.0, 0.0, 0.5)) << "may lie beyond the range";
  EXPECT_FALSE(at(5.0, 0.95, 0.2)) << "may lie beside the sector";
  EXPECT_TRUE(at(10.0, 0.0, 0.5));
}

// Over the sector the density holds all clutter and the few new landmarks of a look. Mutations: a
// density that is flat in range, and the half angle taken for the whole.
TEST(Existence, TheDensityOfTheNewAddsUpOverTheSector) {
  const Existence existence(kSector);
  constexpr int kParts = 2000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double range_m = (i + 0.5) / kParts * kSector.range_m;
    sum += std::exp(-0.5 * existence.cost_of_new(observed(range_m, 0.0)));
  }
  sum *= kSector.range_m / kParts * 2.0 * kSector.half_angle_rad;
  EXPECT_NEAR(sum, kSector.false_per_look + 0.1, 1e-4);
  const double twice_as_far = existence.cost_of_new(observed(14.0, 0.0));
  EXPECT_NEAR(existence.cost_of_new(observed(7.0, 0.0)) - twice_as_far, 2.0 * std::log(2.0), 1e-9);
}

}  // namespace
}  // namespace stereobench::slam
