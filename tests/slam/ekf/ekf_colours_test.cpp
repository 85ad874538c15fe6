// Whose sighting it is, where EKF-SLAM is told a colour and no more.
#include <gtest/gtest.h>

#include "slam/ekf/ekf_slam.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

RangeBearing coloured(const Eigen::Vector2d& range_bearing, int colour) {
  RangeBearing seen = sighting(range_bearing, 0.05, 0.01);
  seen.colour_class = colour;
  return seen;
}

// Catches association by the order of discovery, and two sightings of one frame that share a landmark.
TEST(EkfSlam, AColourIsMatchedToTheLikeliestLandmarkThatIsFree) {
  EkfSlam filter({.odometry_noise = {.v_constant_mps = 0.05}}, {});
  filter.update(
      std::vector<RangeBearing>{coloured({3.0, 0.0}, 4), coloured({3.2, 0.0}, 4), coloured({3.1, 0.0}, 5)});
  for (int i = 0; i < 8; ++i) filter.update(std::vector<RangeBearing>{coloured({3.22, 0.0}, 4)});
  const Estimate once = filter.estimate();
  ASSERT_EQ(once.landmarks.size(), 3u);
  EXPECT_TRUE(near(once.landmarks[0].position_m, Eigen::Vector2d(3.0, 0.0), 1e-6));
  EXPECT_NEAR(once.landmarks[1].position_m.x(), 3.22, 0.01);
  EXPECT_TRUE(near(once.landmarks[2].position_m, Eigen::Vector2d(3.1, 0.0), 1e-6));
  filter.update(std::vector<RangeBearing>(3, coloured({3.2, 0.0}, 4)));
  EXPECT_EQ(filter.estimate().landmarks.size(), 4u);  // three of that colour at once
}

// The end of a loop: drift is a hundred times what the filter believes of it.
TEST(EkfSlam, WithinHalfTheColourSpacingItIsTheSameLandmark) {
  for (const bool spacing_is_known : {false, true}) {
    EkfSlam filter(
        {.odometry_noise = {.v_constant_mps = 0.01}, .colour_spacing_m = spacing_is_known ? 10.0 : 0.0}, {});
    filter.update(std::vector<RangeBearing>{coloured({6.0, 0.0}, 4)});
    filter.predict({1.0, 0.0, 1.0});
    filter.update(std::vector<RangeBearing>{coloured({4.0, 0.0}, 4)});
    const Estimate after = filter.estimate();
    EXPECT_EQ(after.landmarks.size(), spacing_is_known ? 1u : 2u);
    EXPECT_EQ(after.pose.x_m > 1.5, spacing_is_known);  // the way was 2 m, said the landmark
  }
}

// Catches a check for doubles that is left out, and one that does not ask for the colour.
TEST(EkfSlam, TwoNewBallsOfAColourWithinHalfItsSpacingAreOne) {
  for (const int other : {4, 5}) {
    EkfSlam filter({.colour_spacing_m = 10.0}, {});
    filter.update(std::vector<RangeBearing>{coloured({3.0, 0.0}, 4), coloured({4.0, 0.0}, other)});
    EXPECT_EQ(filter.estimate().landmarks.size(), other == 4 ? 1u : 2u);
    EXPECT_EQ(filter.estimate().counters.gated_measurements, other == 4 ? 1 : 0);
  }
}

}  // namespace
}  // namespace stereobench::slam
