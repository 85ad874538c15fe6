// What a particle's map takes in, and what it lets go.
#include "slam/association/map_management.h"

#include <gtest/gtest.h>

#include "slam/fastslam/drawn_particle.h"
#include "slam/math/random.h"

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

// What becomes of the sightings of a frame.
std::vector<Target> update(MapManagement& management, Particle& particle, const std::vector<Sighting>& frame,
                           std::vector<Target> targets = {}) {
  long counted = 0;
  targets.resize(frame.size());
  const Linearised model;
  DrawnParticle<Linearised> drawn{particle, model, management.existence(), counted};
  management.update(drawn, frame, targets, counted);
  return targets;
}

bool add(MapManagement& management, Particle& particle, const Sighting& sighting) {
  return update(management, particle, {sighting}).front().outcome == Outcome::kAdd;
}

std::size_t alive(const Particle& particle) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < particle.classed.size(); ++i)
    count += Existence::is_dead(particle.classed[i].status.log_odds) ? 0U : 1U;
  return count;
}

// A robot that stands still among clutter. Mutation: no place of a dead landmark is taken.
TEST(MapManagement, TheClutterOfOnePlaceDoesNotFillTheMap) {
  MapManagement management(config_with_sector());
  Particle particle;
  RandomStream random(1, Stream::kClutter);
  for (int look = 0; look < 500; ++look) {
    std::vector<Sighting> frame;
    for (int i = 0; i < 2; ++i)
      frame.push_back(seen(20.0 * random.uniform(), 3.0 * random.uniform() - 1.5, 2 * look + i));
    update(management, particle, frame);
  }
  EXPECT_LT(particle.classed.size(), 60u) << "of a thousand";
  EXPECT_LT(alive(particle), 50u);
}

// Mutations: landmarks that were seen lose odds as well; none does.
TEST(MapManagement, OnlyWhatShouldHaveBeenSeenLosesOdds) {
  MapManagement management(config_with_sector());
  Particle particle;
  update(management, particle, {seen(5.0, 0.0, 0), seen(5.0, 1.0, 1), seen(5.0, 3.0, 2), seen(30.0, 0.0, 3)});
  ASSERT_EQ(particle.classed.size(), 4u);
  const auto log_odds = [&](std::size_t j) { return particle.classed[j].status.log_odds; };
  const float before = log_odds(0);
  update(management, particle, {seen(5.0, 0.0, 4)}, {{Outcome::kUse, 0}});
  EXPECT_EQ(log_odds(0), before) << "was seen";
  EXPECT_LT(log_odds(1), before) << "was not";
  EXPECT_EQ(log_odds(2), before) << "is behind";
  EXPECT_EQ(log_odds(3), before) << "is beyond the range";
}

// From the corrected pose a sighting beside a landmark that nobody else claims may be that one; beside a
// claimed one it is another. Mutations: claims forgotten; the doubtful landmark taken for missed.
TEST(MapManagement, WhatMayBeMappedIsNotNew) {
  MapManagement management(config_with_sector());
  Particle particle;
  ASSERT_TRUE(add(management, particle, seen(5.0, 0.0, 0)));
  const float before = particle.classed[0].status.log_odds;
  const std::vector<Target> alone = update(management, particle, {seen(5.3, 0.0, 1), seen(9.0, 0.0, 2)});
  EXPECT_EQ(alone[0].outcome, Outcome::kIgnore);
  EXPECT_EQ(alone[1].outcome, Outcome::kAdd);
  EXPECT_EQ(particle.classed[0].status.log_odds, before) << "neither seen nor missed";
  const std::vector<Target> beside =
      update(management, particle, {seen(5.0, 0.0, 3), seen(5.3, 0.0, 4)}, {{Outcome::kUse, 0}});
  EXPECT_EQ(beside[1].outcome, Outcome::kAdd);
  EXPECT_EQ(particle.classed.size(), 3u);
  EXPECT_EQ(particle.classed[2].status.origin, 4);
}

// Mutation: dead landmarks still stand in the way of new ones.
TEST(MapManagement, TheDeadAreInNobodysWay) {
  for (const double spacing_m : {0.0, 4.0}) {
    FilterConfig config = config_with_sector();
    config.colour_spacing_m = spacing_m;
    MapManagement management(config);
    Particle particle;
    ASSERT_TRUE(add(management, particle, seen(5.0, 0.0, 0)));
    while (alive(particle) > 0) update(management, particle, {});
    EXPECT_TRUE(add(management, particle, seen(5.0, 0.0, 7)));
    ASSERT_EQ(particle.classed.size(), 1u);
    EXPECT_EQ(particle.classed[0].status.origin, 7);
  }
}

}  // namespace
}  // namespace stereobench::slam
