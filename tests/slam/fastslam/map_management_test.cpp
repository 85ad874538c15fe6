// What a particle's map takes in, and what it lets go.
#include "slam/fastslam/map_management.h"

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/linearised.h"

namespace stereobench::slam {
namespace {

FilterConfig config_with_sector() {
  return {.sector = {.range_m = 20.0, .half_angle_rad = 1.5, .miss_probability = 0.1, .false_per_look = 2.0}};
}

Sighting seen(double range_m, double bearing_rad, int number) {
  Sighting sighting;
  sighting.observation = {{range_m, bearing_rad}, Eigen::Vector2d(0.01, 0.0004).asDiagonal()};
  sighting.number = number;
  return sighting;
}

bool add(MapManagement& management, Particle& particle, const Sighting& sighting) {
  long repairs = 0;
  return management.add(particle, sighting, Linearised().found(particle.pose, sighting.observation, repairs));
}

std::size_t alive(const Particle& particle) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < particle.classed.size(); ++i)
    count += Existence::is_dead(particle.classed[i].log_odds) ? 0U : 1U;
  return count;
}

// A robot that stands still among clutter. Mutation: no place of a dead landmark is taken.
TEST(MapManagement, TheClutterOfOnePlaceDoesNotFillTheMap) {
  MapManagement management(config_with_sector());
  Particle particle;
  RandomStream random(1, Stream::kClutter);
  for (int look = 0; look < 500; ++look) {
    management.survey(particle, {}, {});
    for (int i = 0; i < 2; ++i)
      add(management, particle, seen(20.0 * random.uniform(), 3.0 * random.uniform() - 1.5, 2 * look + i));
    management.weaken_unseen(particle);
  }
  EXPECT_LT(particle.classed.size(), 60u) << "of a thousand";
  EXPECT_LT(alive(particle), 50u);
}

// Mutations: landmarks that were seen lose odds as well; none does.
TEST(MapManagement, OnlyWhatShouldHaveBeenSeenLosesOdds) {
  MapManagement management(config_with_sector());
  Particle particle;
  for (const auto& [range_m, bearing_rad] : {std::pair(5.0, 0.0), {5.0, 1.0}, {5.0, 3.0}, {30.0, 0.0}})
    ASSERT_TRUE(add(management, particle, seen(range_m, bearing_rad, 0)));
  const float before = particle.classed[0].log_odds;
  const std::vector<Sighting> frame = {seen(5.0, 0.0, 4)};
  const std::vector<Target> targets = {{Outcome::kUse, 0}};
  management.survey(particle, frame, targets);
  management.weaken_unseen(particle);
  EXPECT_EQ(particle.classed[0].log_odds, before) << "was seen";
  EXPECT_LT(particle.classed[1].log_odds, before) << "was not";
  EXPECT_EQ(particle.classed[2].log_odds, before) << "is behind";
  EXPECT_EQ(particle.classed[3].log_odds, before) << "is beyond the range";
}

// From the corrected pose a sighting beside a landmark that nobody else claims may be that one; beside a
// claimed one it is another. Mutations: claims forgotten; the doubtful landmark taken for missed.
TEST(MapManagement, WhatMayBeMappedIsNotNew) {
  MapManagement management(config_with_sector());
  Particle particle;
  ASSERT_TRUE(add(management, particle, seen(5.0, 0.0, 0)));
  const float before = particle.classed[0].log_odds;
  management.survey(particle, {}, {});
  EXPECT_FALSE(add(management, particle, seen(5.3, 0.0, 1)));
  EXPECT_TRUE(add(management, particle, seen(9.0, 0.0, 2)));
  management.weaken_unseen(particle);
  EXPECT_EQ(particle.classed[0].log_odds, before) << "neither seen nor missed";
  const std::vector<Sighting> frame = {seen(5.0, 0.0, 3), seen(5.3, 0.0, 4)};
  const std::vector<Target> targets = {{Outcome::kUse, 0}, {Outcome::kAdd}};
  management.survey(particle, frame, targets);
  EXPECT_TRUE(add(management, particle, frame[1]));
  EXPECT_EQ(particle.classed.size(), 3u);
  EXPECT_EQ(particle.classed[2].origin, 4);
}

// Mutation: dead landmarks still stand in the way of new ones.
TEST(MapManagement, TheDeadAreInNobodysWay) {
  for (const double spacing_m : {0.0, 4.0}) {
    FilterConfig config = config_with_sector();
    config.colour_spacing_m = spacing_m;
    MapManagement management(config);
    Particle particle;
    ASSERT_TRUE(add(management, particle, seen(5.0, 0.0, 0)));
    while (alive(particle) > 0) {
      management.survey(particle, {}, {});
      management.weaken_unseen(particle);
    }
    management.survey(particle, {}, {});
    EXPECT_TRUE(add(management, particle, seen(5.0, 0.0, 7)));
    ASSERT_EQ(particle.classed.size(), 1u);
    EXPECT_EQ(particle.classed[0].origin, 7);
  }
}

}  // namespace
}  // namespace stereobench::slam
