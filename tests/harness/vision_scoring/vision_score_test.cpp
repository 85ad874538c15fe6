#include "harness/vision_scoring/vision_score.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "tests/harness/scoring/scene.h"

namespace stereobench::harness {
namespace {

TEST(VisionScore, PerfectObservationsScorePerfectly) {
  const Scene scene({kAhead, kAside, kCut});
  const auto outlines = ball_outlines(scene.truth());
  const VisionScore score =
      score_observations(scene.truth(), std::vector{perfect(outlines[0], 3), perfect(outlines[1], 5)});
  EXPECT_EQ(score.visible, 2);  // the cut ball need not be found
  EXPECT_EQ(score.recall(), 1.0);
  EXPECT_EQ(score.precision(), 1.0);
  EXPECT_NEAR(score.range_rms_m(), 0.0, 1e-12);
  EXPECT_NEAR(score.bearing_rms_rad(), 0.0, 1e-12);
  EXPECT_NEAR(score.disparity_rms_px(), 0.0, 1e-12);
}

// Mutations: colours not compared; a second sighting of a ball counted as right; flagged ones counted.
TEST(VisionScore, EveryKindOfMistakeHasItsCount) {
  const Scene scene({kAhead, kAside});
  const auto outlines = ball_outlines(scene.truth());
  const vision::BallObservation right = perfect(outlines[0], 3);
  vision::BallObservation elsewhere = right;
  elsewhere.left_px.x() += 60.0;
  vision::BallObservation one_camera = right;
  one_camera.right_px.x() -= 60.0;
  vision::BallObservation flagged = perfect(outlines[1], 5);
  flagged.occluded = true;
  const VisionScore score = score_observations(
      scene.truth(), std::vector{right, right, perfect(outlines[1], 4), elsewhere, one_camera, flagged});
  EXPECT_EQ(score.observations, 5);
  EXPECT_EQ(score.right, 1);
  EXPECT_EQ(score.repeated, 1);
  EXPECT_EQ(score.misidentified, 1);
  EXPECT_EQ(score.spurious, 2);
  EXPECT_EQ(score.flagged, 1);
  EXPECT_EQ(score.visible, 2);
  EXPECT_EQ(score.found, 1);
  EXPECT_DOUBLE_EQ(score.precision(), 0.2);
  EXPECT_EQ(score.range_errors_m.size(), 1U);
}

// A detector that knows no colours is not wrong about them. Mutation: kUnknown compared as a colour.
TEST(VisionScore, WhoClaimsNoColourIsRightOnAnyBall) {
  const Scene scene({kAhead, kAside});
  const auto outlines = ball_outlines(scene.truth());
  const VisionScore score = score_observations(
      scene.truth(), std::vector{perfect(outlines[0], slam::kUnknown), perfect(outlines[1], slam::kUnknown)});
  EXPECT_EQ(score.right, 2);
  EXPECT_EQ(score.found, 2);
}

// What says nothing of heights is looked for at each ball's, and of two in one direction the nearer in range
// is meant. Mutation: the first ball of a direction.
TEST(VisionScore, RangeAndBearingAloneTellWhichBallIsMeant) {
  const worlds::Ball low{{1.5, 0.0, 0.05}, 0.06, 2};
  const worlds::Ball high{{2.4, 0.0, 0.65}, 0.06, 4};
  const Scene scene({low, high});
  const auto outlines = ball_outlines(scene.truth());
  std::vector<vision::BallObservation> seen;
  for (const BallInPair& outline : {outlines[1], outlines[0]}) {
    seen.push_back(perfect(outline, slam::kUnknown));
    seen.back().has_pixels = false;
    seen.back().left_px = seen.back().right_px = {1.0, 1.0};
  }
  EXPECT_EQ(balls_observed(match_observations(scene.truth(), seen)), (std::vector{1, 0}));
  seen.push_back(seen[0]);
  seen.back().range_bearing.bearing_rad += 0.1;
  seen.push_back(seen[0]);
  seen.back().range_bearing.bearing_rad = 3.0;
  const VisionScore score = score_observations(scene.truth(), seen);
  EXPECT_EQ(score.right, 2);
  EXPECT_EQ(score.spurious, 2);
  EXPECT_NEAR(score.range_rms_m(), 0.0, 1e-12);
  EXPECT_TRUE(score.disparity_errors_px.empty());
}

TEST(VisionScore, AHiddenBallNeedNotBeFoundAndAFarOneIsTooSmall) {
  const Scene scene({kAhead, kBehindIt, {{20.0, -4.0, 0.3}, 0.1, 9}});
  EXPECT_EQ(score_observations(scene.truth(), {}).visible, 1);
  EXPECT_EQ(score_observations(scene.truth(), {}).recall(), 0.0);
}

// A ball slides past another one: it must be found where each camera sees 95 % of it, give or take the
// pixels' own 3 %. Mutations: half of it is enough; one camera is enough.
TEST(VisionScore, ABallMustBeFoundWhereBothCamerasSeeNearlyAllOfIt) {
  int hidden_from_one = 0;
  int half_hidden = 0;
  for (double y_m = -0.2; y_m < 0.38; y_m += 0.05) {
    const worlds::Ball in_front{{1.0, y_m, 0.3}, 0.08, 3};
    const double left = seen_fraction(kBehindIt, in_front, vision::Side::kLeft);
    const double right = seen_fraction(kBehindIt, in_front, vision::Side::kRight);
    const double less = std::min(left, right);
    if (std::abs(less - 0.95) < 0.03) continue;
    hidden_from_one += less < 0.92 && std::max(left, right) == 1.0 ? 1 : 0;
    half_hidden += less > 0.5 && less < 0.92 ? 1 : 0;
    const Scene scene({kBehindIt, in_front});
    EXPECT_EQ(score_observations(scene.truth(), {}).visible, less > 0.95 ? 2 : 1) << left << " " << right;
  }
  EXPECT_GT(hidden_from_one, 0);
  EXPECT_GT(half_hidden, 0);
}

// Mutation: from one pixel.
TEST(VisionScore, ABallMustBeFoundFromFivePixelsOfRadius) {
  int small = 0;
  int large = 0;
  for (double radius_px = 3.1; radius_px < 7.0; radius_px += 0.2) {
    const Scene scene({{{small_rig().intrinsics.focal_px * 0.1 / radius_px, 0.0, 0.3}, 0.1, 3}});
    const BallInPair outline = ball_outlines(scene.truth()).at(0);
    if (std::min(outline.left_fraction, outline.right_fraction) < 0.95) continue;  // so few pixels are coarse
    ++(radius_px > 5.0 ? large : small);
    EXPECT_EQ(score_observations(scene.truth(), {}).visible, radius_px > 5.0 ? 1 : 0) << radius_px;
  }
  EXPECT_GT(small, 2);
  EXPECT_GT(large, 2);
}

// Mutation: looking for it under the observation nevertheless.
TEST(VisionScore, AWhollyHiddenBallIsNotWhatIsObserved) {
  const Scene scene({{{1.3, 0.0, 0.3}, 0.05, 5}, {{1.0, 0.0, 0.3}, 0.2, 3}});
  const auto outlines = ball_outlines(scene.truth());
  const VisionScore score = score_observations(scene.truth(), std::vector{perfect(outlines[0], 5)});
  EXPECT_EQ(score.misidentified, 1);
  EXPECT_EQ(score.right, 0);
}

// Mutation: taking the first ball whatever its colour.
TEST(VisionScore, WhereOutlinesOverlapTheColourSaysWhichBallItIs) {
  const Scene scene({{{1.0, 0.1, 0.3}, 0.1, 3}, {{1.6, 0.25, 0.3}, 0.2, 5}});
  const auto outlines = ball_outlines(scene.truth());
  ASSERT_TRUE(contains(outlines[0].left, outlines[1].left.centre_px));
  ASSERT_TRUE(contains(outlines[0].right, outlines[1].right.centre_px));
  const VisionScore score = score_observations(scene.truth(), std::vector{perfect(outlines[1], 5)});
  EXPECT_EQ(score.right, 1);
  EXPECT_NEAR(score.range_rms_m(), 0.0, 1e-12);
}

TEST(VisionScore, ErrorsAreMeasuredMinusTrue) {
  const Scene scene({kAhead});
  vision::BallObservation observation = perfect(ball_outlines(scene.truth())[0], 3);
  observation.range_bearing.range_m += 0.02;
  observation.range_bearing.bearing_rad -= 0.003;
  observation.right_px.x() -= 0.5;
  const VisionScore score = score_observations(scene.truth(), std::vector{observation});
  EXPECT_NEAR(score.range_errors_m.at(0), 0.02, 1e-12);
  EXPECT_NEAR(score.bearing_errors_rad.at(0), -0.003, 1e-12);
  EXPECT_NEAR(score.disparity_errors_px.at(0), 0.5, 1e-12);
  EXPECT_NEAR(score.normalised_errors.at(0), (4.0 + 9.0) / 2.0, 1e-9);
}

TEST(VisionScore, NothingSeenIsNotZero) {
  const VisionScore score;
  EXPECT_TRUE(std::isnan(score.recall()));
  EXPECT_TRUE(std::isnan(score.precision()));
  EXPECT_TRUE(std::isnan(score.range_rms_m()));
}

// Mutation: forgetting one.
TEST(VisionScore, MergingAddsEveryCount) {
  VisionScore score{1, 2, 3, 4, 5, 6, 7, 8, {}, {}, {}, {}};
  score += VisionScore{10, 20, 30, 40, 50, 60, 70, 80, {}, {}, {}, {}};
  EXPECT_EQ(score.visible, 11);
  EXPECT_EQ(score.found, 22);
  EXPECT_EQ(score.observations, 33);
  EXPECT_EQ(score.right, 44);
  EXPECT_EQ(score.misidentified, 55);
  EXPECT_EQ(score.spurious, 66);
  EXPECT_EQ(score.repeated, 77);
  EXPECT_EQ(score.flagged, 88);
}

// Mutation: summing in the order of merging, whose last bits depend on it.
TEST(VisionScore, MergesToTheSameBitsInAnyOrder) {
  slam::RandomStream random(5, slam::Stream::kWorld);
  std::vector<VisionScore> scores(200);
  for (VisionScore& score : scores) {
    score.visible = score.found = 1;
    score.range_errors_m = {random.normal(), 1e-3 * random.normal()};
    score.bearing_errors_rad = score.disparity_errors_px = score.normalised_errors = score.range_errors_m;
  }
  VisionScore forwards;
  VisionScore backwards;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    forwards += scores[i];
    backwards += scores[scores.size() - 1 - i];
  }
  EXPECT_EQ(forwards.visible, 200);
  EXPECT_EQ(forwards.range_errors_m.size(), 400U);
  EXPECT_EQ(forwards.range_rms_m(), backwards.range_rms_m());
  EXPECT_EQ(forwards.bearing_rms_rad(), backwards.bearing_rms_rad());
  EXPECT_EQ(forwards.disparity_rms_px(), backwards.disparity_rms_px());
  EXPECT_EQ(forwards.mean_normalised_error(), backwards.mean_normalised_error());
}

}  // namespace
}  // namespace stereobench::harness
