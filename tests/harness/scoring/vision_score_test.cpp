#include "harness/scoring/vision_score.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "slam/motion.h"
#include "slam/random.h"
#include "vision/rig.h"

namespace stereobench::harness {
namespace {

vision::StereoRig small_rig() {
  vision::StereoRig rig;
  rig.camera = {320, 240, 300.0, 159.5, 119.5};
  return rig;
}

/// Which ball each pixel's centre sees, by rays and spheres: shares nothing with the closed-form outline.
cv::Mat ball_ids(const worlds::World& world, const vision::StereoRig& rig, const slam::Pose& pose,
                 vision::Eye eye) {
  const Eigen::Isometry3d robot_from_eye = vision::robot_from_camera(rig, eye);
  const Eigen::AngleAxisd turn(pose.heading_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d world_from_eye =
      Eigen::Translation3d(pose.x_m, pose.y_m, 0.0) * turn * robot_from_eye;
  cv::Mat ids(rig.camera.height_px, rig.camera.width_px, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < ids.rows; ++v) {
    for (int u = 0; u < ids.cols; ++u) {
      const Eigen::Vector3d ray =
          world_from_eye.linear() * vision::pixel_ray(rig.camera, {u, v}).normalized();
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < world.balls.size(); ++i) {
        const Eigen::Vector3d offset = world.balls[i].centre_m - world_from_eye.translation();
        const double along = offset.dot(ray);
        const double miss = std::pow(world.balls[i].radius_m, 2) - (offset - along * ray).squaredNorm();
        if (miss < 0.0 || along < 0.0 || along >= nearest) continue;
        nearest = along;
        ids.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(i + 1);
      }
    }
  }
  return ids;
}

/// A world with its rendered identities.
struct Scene {
  worlds::World world;
  vision::StereoRig rig = small_rig();
  slam::Pose pose;
  renderer::StereoFrame frame;

  explicit Scene(std::vector<worlds::Ball> balls, const slam::Pose& world_from_robot = {})
      : pose(world_from_robot) {
    world.balls = std::move(balls);
    frame.left.ball_id = ball_ids(world, rig, pose, vision::Eye::kLeft);
    frame.right.ball_id = ball_ids(world, rig, pose, vision::Eye::kRight);
  }
  VisionTruth truth() const { return {world, rig, pose, frame}; }
};

/// What a perfect observer says of a ball.
vision::BallObservation perfect(const BallOutline& outline, int colour) {
  vision::BallObservation observation;
  observation.colour = colour;
  observation.left_px = outline.left.centre_px;
  observation.right_px = outline.right.centre_px;
  observation.range_bearing.range_m = outline.ball_in_robot.head<2>().norm();
  observation.range_bearing.bearing_rad = std::atan2(outline.ball_in_robot.y(), outline.ball_in_robot.x());
  observation.range_bearing.covariance = Eigen::Vector2d(1e-4, 1e-6).asDiagonal();
  return observation;
}

const worlds::Ball kAhead{{1.0, 0.1, 0.3}, 0.1, 3};
const worlds::Ball kBehindIt{{1.6, 0.1, 0.3}, 0.1, 5};
const worlds::Ball kAside{{1.5, -0.45, 0.35}, 0.08, 5};
const worlds::Ball kCut{{1.0, 0.55, 0.3}, 0.1, 7};
const worlds::Ball kAtTheBack{{-1.0, 0.0, 0.3}, 0.1, 8};

TEST(BallOutlines, AWholeBallHasThePixelsOfItsOutline) {
  const Scene scene({kAhead, kAtTheBack, kAside});
  const std::vector<BallOutline> outlines = ball_outlines(scene.truth());
  ASSERT_EQ(outlines.size(), 2U);  // nothing is said of the ball at the back
  EXPECT_EQ(outlines[1].ball, 2);
  for (const BallOutline& outline : outlines) {
    EXPECT_TRUE(outline.inside_both);
    EXPECT_NEAR(outline.left_fraction, 1.0, 0.03);
    EXPECT_NEAR(outline.right_fraction, 1.0, 0.03);
  }
}

// Mutations: left identities for both eyes; heading with the wrong sign; fractions of the bounding box.
TEST(BallOutlines, HiddenAndCutBallsHaveLess) {
  const Scene scene({kAhead, kBehindIt, kCut});
  const std::vector<BallOutline> outlines = ball_outlines(scene.truth());
  ASSERT_EQ(outlines.size(), 3U);
  EXPECT_LT(outlines[1].left_fraction, 0.5);
  EXPECT_FALSE(outlines[2].inside_both);
  EXPECT_LT(std::min(outlines[2].left_fraction, outlines[2].right_fraction), 0.95);
}

class AnyPlace : public testing::TestWithParam<std::uint64_t> {};

// Turning the robot and its world together changes nothing.
TEST_P(AnyPlace, OutlinesDoNotDependOnWhereTheWorldIs) {
  slam::RandomStream random(GetParam(), slam::Stream::kWorld);
  const slam::Pose pose{random.normal(), random.normal(), slam::wrap_angle(3.0 * random.normal())};
  worlds::Ball moved = kAside;
  const slam::Pose centre = slam::compose(pose, {kAside.centre_m.x(), kAside.centre_m.y(), 0.0});
  moved.centre_m.head<2>() = Eigen::Vector2d(centre.x_m, centre.y_m);
  const BallOutline here = ball_outlines(Scene({kAside}).truth()).at(0);
  const BallOutline there = ball_outlines(Scene({moved}, pose).truth()).at(0);
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
  vision::BallObservation one_eye = right;
  one_eye.right_px.x() -= 60.0;
  vision::BallObservation flagged = perfect(outlines[1], 5);
  flagged.occluded = true;
  const VisionScore score = score_observations(
      scene.truth(), std::vector{right, right, perfect(outlines[1], 4), elsewhere, one_eye, flagged});
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

TEST(VisionScore, AHiddenBallNeedNotBeFoundAndAFarOneIsTooSmall) {
  const Scene scene({kAhead, kBehindIt, {{20.0, -4.0, 0.3}, 0.1, 9}});
  EXPECT_EQ(score_observations(scene.truth(), {}).visible, 1);
  EXPECT_EQ(score_observations(scene.truth(), {}).recall(), 0.0);
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
