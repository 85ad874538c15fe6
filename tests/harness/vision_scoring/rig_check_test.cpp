// What a run says of a rig that is not as it is believed to be.
#include "harness/vision_scoring/rig_check.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/angles.h"
#include "slam/math/random.h"
#include "vision/camera/rig.h"
#include "vision/stereo/sphere.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kRadius_m = 0.06;

/// Balls all over the pictures, as a rig sees them exactly.
std::vector<vision::BallObservation> seen_by(const vision::StereoRig& rig) {
  slam::RandomStream random(3, slam::Stream::kWorld);
  std::vector<vision::BallObservation> seen;
  for (int i = 0; i < 40; ++i) {
    const double depth_m = 1.0 + 4.0 * random.uniform();
    const Eigen::Vector3d ball =
        depth_m * Eigen::Vector3d(random.uniform() - 0.4, 0.6 * random.uniform() - 0.3, 1.0);
    const auto left = vision::sphere_outline(rig.intrinsics, ball, kRadius_m);
    const auto right = vision::sphere_outline(
        rig.intrinsics, vision::camera_point(rig, ball, vision::Side::kRight), kRadius_m);
    vision::BallObservation observation;
    observation.left_px = left->centre_px;
    observation.right_px = right->centre_px;
    observation.left_radius_px = left->radius_px();
    observation.right_radius_px = right->radius_px();
    seen.push_back(observation);
  }
  return seen;
}

// f tan(0.05 deg) are 0.77 px. Mutations: the sign of the rows; the turn of the left camera.
TEST(RigCheck, SaysByWhatTheRowsAreOff) {
  vision::StereoRig rig;
  rig.right_turn_rad = {0.05 * slam::kRadPerDegree, 0.0, 0.0};
  const RigCheck check = check_rig(vision::StereoRig{}, {kRadius_m, 0.0}, seen_by(rig));
  const auto json = rig_json(check);
  EXPECT_NEAR(json["rows_off_px"]["left"].get<double>(), -0.774, 0.01);
  EXPECT_NEAR(json["rows_off_px"]["right"].get<double>(), -0.774, 0.01);
  EXPECT_NEAR(json["size_disagrees"]["share"].get<double>(), 0.0, 0.001);
  EXPECT_THAT(rig_warnings(check),
              ElementsAre(HasSubstr(
                  "px apart at the left, -0.77 at the right: the right camera is turned by 0.050 deg "
                  "about x")));
}

TEST(RigCheck, SaysByWhatSizesDisagree) {
  vision::StereoRig believed;
  believed.baseline_m = 0.125;
  const RigCheck check = check_rig(believed, {kRadius_m, 0.0001}, seen_by(vision::StereoRig{}));
  EXPECT_NEAR(rig_json(check)["size_disagrees"]["share"].get<double>(), -0.04, 0.002);
  EXPECT_THAT(rig_warnings(check), ElementsAre(HasSubstr("the baseline is 0.1200 m in place of 0.1250")));
}

// Radii that a detector does not state are made up of disparities: what these say of sizes is nothing.
// Mutation: check_rig that does not ask has_radii.
TEST(RigCheck, SaysNothingOfSizesThatNobodyMeasured) {
  vision::StereoRig believed;
  believed.baseline_m = 0.125;
  std::vector<vision::BallObservation> seen = seen_by(vision::StereoRig{});
  for (vision::BallObservation& ball : seen) ball.has_radii = false;
  const RigCheck check = check_rig(believed, {kRadius_m, 0.0001}, seen);
  EXPECT_THAT(rig_warnings(check), IsEmpty());
  EXPECT_TRUE(rig_json(check)["size_disagrees"]["share"].is_null());
  EXPECT_NEAR(rig_json(check)["rows_off_px"]["left"].get<double>(), 0.0, 0.01);
}

TEST(RigCheck, SaysNothingOfARigAsBelieved) {
  vision::StereoRig rig;
  rig.right_turn_rad = {0.01, -0.005, 0.02};
  rig.distortion.k1 = -0.1;
  std::vector<vision::BallObservation> taken = seen_by(rig);
  for (vision::BallObservation& ball : taken) {  // as the lens has them
    ball.left_px = vision::image_point(rig, vision::pixel_ray(rig.intrinsics, ball.left_px));
    ball.right_px = vision::image_point(rig, vision::pixel_ray(rig.intrinsics, ball.right_px));
  }
  EXPECT_THAT(rig_warnings(check_rig(rig, {kRadius_m, 0.001}, taken)), IsEmpty());
  EXPECT_THAT(rig_warnings({}), IsEmpty());
  EXPECT_TRUE(rig_json({})["rows_off_px"]["left"].is_null());
}

}  // namespace
}  // namespace stereobench::harness
