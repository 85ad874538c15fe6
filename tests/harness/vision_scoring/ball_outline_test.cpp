#include "harness/vision_scoring/ball_outline.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/motion.h"
#include "tests/harness/scoring/scene.h"

namespace stereobench::harness {
namespace {

// Mutation: fractions of the bounding box.
TEST(BallOutlines, AWholeBallHasThePixelsOfItsOutline) {
  const Scene scene({kAhead, kAtTheBack, kAside});
  const std::vector<BallInPair> outlines = ball_outlines(scene.truth());
  ASSERT_EQ(outlines.size(), 2U);  // nothing is said of the ball at the back
  EXPECT_EQ(outlines[1].ball, 2);
  for (const BallInPair& outline : outlines) {
    EXPECT_TRUE(outline.inside_both);
    EXPECT_NEAR(outline.left_fraction, 1.0, 0.03);
    EXPECT_NEAR(outline.right_fraction, 1.0, 0.03);
  }
}

TEST(BallOutlines, HiddenAndCutBallsHaveLess) {
  const Scene scene({kAhead, kBehindIt, kCut});
  const std::vector<BallInPair> outlines = ball_outlines(scene.truth());
  ASSERT_EQ(outlines.size(), 3U);
  EXPECT_LT(outlines[1].left_fraction, 0.5);
  EXPECT_FALSE(outlines[2].inside_both);
  EXPECT_LT(std::min(outlines[2].left_fraction, outlines[2].right_fraction), 0.95);
}

// Mutation: left identities for both cameras.
TEST(BallOutlines, EachCameraHasItsOwnFraction) {
  for (const double y_m : {-0.05, 0.17}) {
    const worlds::Ball in_front{{1.0, y_m, 0.3}, 0.08, 3};
    const BallInPair outline = ball_outlines(Scene({kBehindIt, in_front}).truth()).at(0);
    const double left = seen_fraction(kBehindIt, in_front, vision::Side::kLeft);
    const double right = seen_fraction(kBehindIt, in_front, vision::Side::kRight);
    EXPECT_NEAR(outline.left_fraction, left, 0.04);
    EXPECT_NEAR(outline.right_fraction, right, 0.04);
    EXPECT_GT(std::abs(left - right), 0.1);
  }
}

// Mutation: inside one image is enough.
TEST(BallOutlines, CutInOneCameraIsNotInsideBoth) {
  for (const double y_m : {-0.43, 0.43})
    EXPECT_FALSE(ball_outlines(Scene({{{1.0, y_m, 0.3}, 0.1, 3}}).truth()).at(0).inside_both) << y_m;
  for (const double y_m : {-0.35, 0.35})
    EXPECT_TRUE(ball_outlines(Scene({{{1.0, y_m, 0.3}, 0.1, 3}}).truth()).at(0).inside_both) << y_m;
}

class AnyPlace : public testing::TestWithParam<std::uint64_t> {};

// Turning the robot and its world together changes nothing. Mutation: heading with the wrong sign.
TEST_P(AnyPlace, OutlinesDoNotDependOnWhereTheWorldIs) {
  slam::RandomStream random(GetParam(), slam::Stream::kWorld);
  const slam::Pose pose{random.normal(), random.normal(), slam::wrap_angle(3.0 * random.normal())};
  worlds::Ball moved = kAside;
  const slam::Pose centre = slam::compose(pose, {kAside.centre_m.x(), kAside.centre_m.y(), 0.0});
  moved.centre_m.head<2>() = Eigen::Vector2d(centre.x_m, centre.y_m);
  const BallInPair here = ball_outlines(Scene({kAside}).truth()).at(0);
  const BallInPair there = ball_outlines(Scene({moved}, pose).truth()).at(0);
  EXPECT_LT((here.left.centre_px - there.left.centre_px).norm(), 1e-9);
  EXPECT_LT((here.right.centre_px - there.right.centre_px).norm(), 1e-9);
  EXPECT_NEAR(here.left_fraction, there.left_fraction, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyPlace, testing::Range<std::uint64_t>(0, 10));

TEST(Contains, IsTheEllipse) {
  const vision::OutlineEllipse outline{{10.0, 20.0}, 4.0, 2.0, M_PI / 2.0};  // upright
  EXPECT_TRUE(contains(outline, {10.0, 23.9}));
  EXPECT_FALSE(contains(outline, {10.0, 24.1}));
  EXPECT_TRUE(contains(outline, {11.9, 20.0}));
  EXPECT_FALSE(contains(outline, {12.1, 20.0}));
}

}  // namespace
}  // namespace stereobench::harness
