// What filters are given of what a detector found.
#include "harness/drive/sightings.h"

#include <set>

#include <gtest/gtest.h>

#include "harness/detector/detector_registry.h"
#include "harness/experiment/experiment.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/run/assemble.h"

namespace stereobench::harness {
namespace {

using worlds::Identity;

/// Balls of colours 4, 2 and 7.
const std::vector<worlds::Ball> kBalls = {{.colour = 4}, {.colour = 2}, {.colour = 7}};

vision::BallObservation observation_of(int colour) {
  vision::BallObservation observation;
  observation.colour = colour;
  observation.range_bearing.range_m = 1.0 + colour;
  observation.range_bearing.colour_class = colour;
  return observation;
}

std::vector<int> identities_of(const std::vector<int>& colours, Identity identity) {
  std::vector<vision::BallObservation> observations;
  for (const int colour : colours) observations.push_back(observation_of(colour));
  const std::vector<int> balls(colours.size(), slam::kUnknown);
  std::vector<int> identities;
  for (const slam::RangeBearing& sighting : sightings_of(observations, balls, kBalls, identity).measurements)
    identities.push_back(sighting.landmark_id);
  return identities;
}

// A filter must not learn which colours the world holds. Mutation: colours that no ball has are left out.
TEST(SightingsOf, EveryColourIsAnIdentityWhereIdentitiesAreKnown) {
  const std::vector<int> identities = identities_of({7, 0, 4, 5, 2, 0, 17}, Identity::kKnown);
  ASSERT_EQ(identities.size(), 7U);
  EXPECT_EQ(identities[0], 2) << "the index of the ball of that colour";
  EXPECT_EQ(identities[2], 0);
  EXPECT_EQ(identities[4], 1);
  EXPECT_EQ(identities[1], identities[5]) << "of one colour";
  EXPECT_EQ(std::set<int>(identities.begin(), identities.end()).size(), 6U) << "six colours";
  for (const std::size_t imagined : {1U, 3U, 6U}) EXPECT_GE(identities[imagined], 3) << "no ball's";
}

// Mutation: an observation without a colour is given the identity of the last ball.
TEST(SightingsOf, WithoutAColourThereIsNoIdentity) {
  EXPECT_EQ(identities_of({slam::kUnknown, 4}, Identity::kKnown), std::vector<int>{0});
  EXPECT_EQ(identities_of({slam::kUnknown, 4}, Identity::kColourClass).size(), 2U);
  EXPECT_EQ(identities_of({slam::kUnknown, 4}, Identity::kNone).size(), 2U);
}

// Mutation: the trusted ones alone are kept, but not their balls.
TEST(SightingsOf, WhatIsNotTrustedIsLeftOutWithItsBall) {
  std::vector<vision::BallObservation> observations = {observation_of(4), observation_of(2),
                                                       observation_of(7)};
  observations[1].occluded = true;
  const Sightings seen = sightings_of(observations, std::vector<int>{0, 1, 2}, kBalls, Identity::kKnown);
  EXPECT_EQ(seen.balls, (std::vector<int>{0, 2}));
  ASSERT_EQ(seen.measurements.size(), 2U);
  EXPECT_EQ(seen.measurements[1].range_m, 8.0);
}

/// Sees one thing at each look that is not there, of a colour that no ball of the scenario has.
vision::BallObservation imagined() {
  vision::BallObservation ghost = observation_of(17);
  ghost.range_bearing.range_m = 0.7;
  ghost.range_bearing.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
  return ghost;
}

// End to end: what a detector imagines is in the filters' maps, as nobody's. Mutation: as above.
TEST(SightingsOf, WhatADetectorImaginesIsInTheMap) {
  if (find_detector("imagines") == nullptr)
    register_detector({"imagines", [](const DetectorSetup&) -> Detector {
                         return [](const DetectorInput&) { return std::vector{imagined()}; };
                       }});
  Experiment experiment = read_experiment(scenario_path("ball_circle"),
                                          {"path.laps=0.05", "rig.width_px=256", "rig.height_px=192",
                                           "rig.focal_px=222", "filters=[fastslam2]", "detector=imagines"});
  worlds::Scenario& scenario = experiment.scenario;
  std::erase_if(scenario.world.balls, [](const worlds::Ball& ball) { return ball.colour == 17; });
  scenario.world.meshes.clear();  // stands name their balls by place
  const DriveTask task{.experiment = &experiment};
  const RunResult result = assemble("name", "osmesa", {drive_seed(task, [](double) {})});
  EXPECT_EQ(result.vision->spurious, static_cast<long>(scenario.path.size()));
  EXPECT_EQ(result.filters.front().summary.landmarks_spurious, 1);
}

}  // namespace
}  // namespace stereobench::harness
