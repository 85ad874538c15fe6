#include "harness/detector/detection_lines.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/json/json_line.h"
#include "slam/math/random.h"
#include "vision/camera/rig.h"
#include "vision/stereo/range_bearing.h"
#include "vision/stereo/sphere.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::BallObservation;

const BallGeometry kGeometry = {{{1024, 768, 887.0, 511.5, 383.5}, 0.12, 0.3, 0.1}, 0.06};

/// A ball somewhere ahead with all that our detector says of one.
BallObservation random_ball(slam::RandomStream& random) {
  const Eigen::Vector3d place(random.normal(), 0.3 * random.normal(), 1.0 + 6.0 * random.uniform());
  const vision::StereoRig& rig = kGeometry.rig;
  BallObservation ball;
  ball.colour = static_cast<int>(18.0 * random.uniform());
  ball.left_px = vision::sphere_outline(rig.intrinsics, place, kGeometry.radius_m)->centre_px;
  ball.right_px =
      vision::sphere_outline(rig.intrinsics, vision::camera_point(rig, place, vision::Side::kRight),
                             kGeometry.radius_m)
          ->centre_px;
  ball.left_radius_px = 10.0 + random.uniform();
  ball.right_radius_px = 10.0 + random.uniform();
  Eigen::Matrix3d root;
  for (double& entry : root.reshaped()) entry = 0.01 * random.normal();
  const Eigen::Matrix3d covariance = root * root.transpose();
  ball.range_bearing = vision::range_bearing(place, covariance, vision::robot_from_camera(rig));
  ball.range_bearing.colour_class = ball.colour;
  ball.truncated = random.uniform() < 0.2;
  ball.occluded = random.uniform() < 0.2;
  return ball;
}

void expect_same(const BallObservation& a, const BallObservation& b) {
  EXPECT_EQ(a.colour, b.colour);
  EXPECT_EQ(a.left_px, b.left_px);
  EXPECT_EQ(a.right_px, b.right_px);
  EXPECT_EQ(a.left_radius_px, b.left_radius_px);
  EXPECT_EQ(a.right_radius_px, b.right_radius_px);
  EXPECT_EQ(a.has_pixels, b.has_pixels);
  EXPECT_EQ(a.has_radii, b.has_radii);
  EXPECT_EQ(a.range_bearing.range_m, b.range_bearing.range_m);
  EXPECT_EQ(a.range_bearing.bearing_rad, b.range_bearing.bearing_rad);
  EXPECT_EQ(a.range_bearing.covariance, b.range_bearing.covariance);
  EXPECT_EQ(a.range_bearing.colour_class, b.range_bearing.colour_class);
  EXPECT_EQ(a.truncated, b.truncated);
  EXPECT_EQ(a.occluded, b.occluded);
}

// Law: what is written is read back to the last bit, in order. Mutations: numbers of six digits; cameras
// swapped in the reader; flags left out.
TEST(DetectionLines, AreReadBackExactly) {
  slam::RandomStream random(7, slam::Stream::kWorld);
  for (std::size_t frame = 0; frame < 30; ++frame) {
    std::vector<BallObservation> balls;
    for (std::size_t i = 0; i < frame % 5; ++i) balls.push_back(random_ball(random));
    const std::string line = detections_line(frame, balls);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto read = read_detections(line, frame, kGeometry);
    ASSERT_EQ(read.size(), balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) expect_same(read[i], balls[i]);
    EXPECT_EQ(detections_line(frame, read), line);
  }
}

std::vector<BallObservation> read(const std::string& balls) {
  return read_detections("{\"frame\": 3, \"balls\": [" + balls + "]}", 3, kGeometry);
}

// Law: centres alone say what a ball triangulated from them is. Mutation: front surface for
// centre (the ball's radius left out).
TEST(DetectionLines, PixelsAloneAreTriangulatedAsOurOwnAre) {
  slam::RandomStream random(8, slam::Stream::kWorld);
  for (int i = 0; i < 50; ++i) {
    const BallObservation ball = random_ball(random);
    const auto seen =
        read(fmt::format(R"({{"colour": null, "left_px": [{}, {}], "right_px": [{}, {}], )"
                         R"("centre_sd_px": 0.2}})",
                         ball.left_px.x(), ball.left_px.y(), ball.right_px.x(), ball.right_px.y()));
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].colour, slam::kUnknown);
    EXPECT_NEAR(seen[0].range_bearing.range_m, ball.range_bearing.range_m, 1e-9);
    EXPECT_NEAR(seen[0].range_bearing.bearing_rad, ball.range_bearing.bearing_rad, 1e-12);
    const Eigen::Matrix2d of_centre = 0.04 * Eigen::Matrix2d::Identity();
    const auto place =
        vision::triangulate_ball(kGeometry.rig, ball.left_px, ball.right_px, kGeometry.radius_m);
    const auto expected = vision::range_bearing(
        *place,
        vision::ball_covariance(kGeometry.rig, {ball.left_px, ball.right_px, of_centre, of_centre},
                                kGeometry.radius_m),
        vision::robot_from_camera(kGeometry.rig));
    EXPECT_LT((seen[0].range_bearing.covariance - expected.covariance).norm(), 1e-12);
    EXPECT_GT(seen[0].left_radius_px, 0.0);
  }
}

// Law: where a ball is does not depend on the faults that are known of a rig. Mutations: pixels as they are
// taken, the right camera's turn left out.
TEST(DetectionLines, PixelsOfARigWithFaultsAreRectified) {
  BallGeometry faulty = kGeometry;
  faulty.rig.right_turn_rad = {0.01, -0.03, 0.02};
  faulty.rig.distortion = {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001};
  slam::RandomStream random(9, slam::Stream::kWorld);
  for (int i = 0; i < 50; ++i) {
    const BallObservation ball = random_ball(random);
    const auto taken = [&](const Eigen::Vector2d& rectified_px, vision::Side side) {
      const Eigen::Vector3d ray = vision::pixel_ray(faulty.rig.intrinsics, rectified_px);
      return vision::image_point(faulty.rig, vision::camera_direction(faulty.rig, ray, side));
    };
    const Eigen::Vector2d left = taken(ball.left_px, vision::Side::kLeft);
    const Eigen::Vector2d right = taken(ball.right_px, vision::Side::kRight);
    const std::string line = fmt::format(
        R"({{"frame": 0, "balls": [{{"colour": 1, "left_px": [{}, {}], "right_px": [{}, {}]}}]}})", left.x(),
        left.y(), right.x(), right.y());
    const auto seen = read_detections(line, 0, faulty);
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].left_px, left);
    EXPECT_NEAR(seen[0].range_bearing.range_m, ball.range_bearing.range_m, 1e-7);
    EXPECT_NEAR(seen[0].range_bearing.bearing_rad, ball.range_bearing.bearing_rad, 1e-10);
  }
}

// Law: a radius that is not stated is that of the ball's outline, and is not taken for measured. Mutation: f
// R / Z, which is too small away from the middle.
TEST(DetectionLines, RadiiThatAreNotStatedAreThoseOfTheOutline) {
  slam::RandomStream random(11, slam::Stream::kWorld);
  for (int i = 0; i < 20; ++i) {
    const BallObservation ball = random_ball(random);
    const std::string centres =
        fmt::format(R"("colour": 1, "left_px": [{}, {}], "right_px": [{}, {}])", ball.left_px.x(),
                    ball.left_px.y(), ball.right_px.x(), ball.right_px.y());
    const auto seen = read(fmt::format("{{{}}}", centres));
    ASSERT_EQ(seen.size(), 1U);
    const auto outline =
        vision::sphere_outline(kGeometry.rig.intrinsics, seen[0].ball_in_camera, kGeometry.radius_m);
    EXPECT_DOUBLE_EQ(seen[0].left_radius_px, outline->radius_px());
    EXPECT_FALSE(seen[0].has_radii);
    EXPECT_EQ(detections_line(0, seen).find("radius"), std::string::npos);
    const auto stated = read(fmt::format(R"({{{}, "left_radius_px": 9, "right_radius_px": 8}})", centres));
    EXPECT_TRUE(stated.at(0).has_radii);
    EXPECT_EQ(stated.at(0).right_radius_px, 8.0);
  }
}

// Law: a range without pixels is given the pixels whose triangulation is that range again. Mutation: the
// bearing to the right.
TEST(DetectionLines, RangeAloneIsGivenPixelsThatStandForIt) {
  for (const double bearing_rad : {-0.4, 0.0, 0.3})
    for (const double range_m : {0.7, 2.0, 9.0}) {
      const auto seen =
          read(fmt::format(R"({{"colour": 4, "range_m": {}, "bearing_rad": {}}})", range_m, bearing_rad));
      ASSERT_EQ(seen.size(), 1U);
      EXPECT_FALSE(seen[0].has_pixels);
      const auto place =
          vision::triangulate_ball(kGeometry.rig, seen[0].left_px, seen[0].right_px, kGeometry.radius_m);
      const Eigen::Vector3d in_robot = vision::robot_from_camera(kGeometry.rig) * *place;
      EXPECT_NEAR(in_robot.head<2>().norm(), range_m, 1e-9);
      EXPECT_NEAR(std::atan2(in_robot.y(), in_robot.x()), bearing_rad, 1e-9);
      EXPECT_NEAR(in_robot.z(), kGeometry.rig.height_m, 1e-9);
      EXPECT_GT(seen[0].range_bearing.covariance.determinant(), 0.0);
    }
}

TEST(DetectionLines, WhatIsBehindNeedsACovariance) {
  EXPECT_EQ(read(R"({"colour": 1, "range_m": 2, "bearing_rad": 3, "covariance": [[1, 0], [0, 1]]})").size(),
            1U);
  EXPECT_THAT([] { read(R"({"colour": 1, "range_m": 2, "bearing_rad": 3})"); },
              ThrowsMessage<BadLine>(HasSubstr("not ahead of both cameras")));
}

struct Bad {
  std::string kind;
  std::string line;
  std::string message;
};
void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.kind;
}
class BadDetections : public testing::TestWithParam<Bad> {};

// Mutations: no bound on balls; the frame's number not looked at.
TEST_P(BadDetections, AreOneLineThatSaysWhereAndWhat) {
  try {
    read_detections(GetParam().line, 3, kGeometry);
    FAIL() << "expected BadLine";
  } catch (const BadLine& bad) {
    EXPECT_THAT(bad.what(), HasSubstr(GetParam().message));
    EXPECT_EQ(std::string(bad.what()).find('\n'), std::string::npos);
    EXPECT_LT(std::string(bad.what()).size(), 400U);
  }
}

std::string of_ball(const std::string& ball) {
  return "{\"frame\": 3, \"balls\": [{\"colour\": 1, " + ball + "}]}";
}
std::string many_balls() {
  std::string line = R"({"frame": 3, "balls": [{"colour": 1})";
  for (int i = 0; i < 1000; ++i) line += R"(, {"colour": 1})";
  return line + "]}";
}
constexpr const char* kPlace = R"("range_m": 1, "bearing_rad": 0)";

INSTANTIATE_TEST_SUITE_P(
    All, BadDetections,
    testing::Values(
        Bad{"Empty", "", "expected a line of JSON (got '')"}, Bad{"Text", "hello", "JSON (got 'hello')"},
        Bad{"HalfALine", R"({"frame": 3, "ba)", "JSON"},
        Bad{"TwoAnswers", R"({"frame": 3, "balls": []} {"frame": 4})", "JSON"},
        Bad{"ControlCharacters", "\x01\x1b[31m\r\n\x7f", "JSON"},
        Bad{"NotUtf8", "{\"frame\": 3, \"b\xff\xfe\": []}", "JSON"},
        Bad{"NotANumber", of_ball(R"("range_m": NaN, "bearing_rad": 0)"), "JSON"},
        Bad{"TooLargeANumber", of_ball(R"("range_m": 1e999, "bearing_rad": 0)"), "JSON"},
        Bad{"AList", "[]", "expected an object (got [])"}, Bad{"Null", "null", "expected an object"},
        Bad{"NoFrame", R"({"balls": []})", R"(expected "frame")"},
        Bad{"WrongFrame", R"({"frame": 2, "balls": []})", "frame: expected 3 (got 2)"},
        Bad{"FractionalFrame", R"({"frame": 3.0, "balls": []})", "frame: expected 3 (got 3.0)"},
        Bad{"HugeFrame", R"({"frame": 18446744073709551615, "balls": []})", "frame: expected 3"},
        Bad{"NoBalls", R"({"frame": 3})", R"(expected "balls")"},
        Bad{"BallsOfText", R"({"frame": 3, "balls": "none"})", "balls: expected a list"},
        Bad{"TooManyBalls", many_balls(), "balls: expected a list of at most 1000 entries (got 1001)"},
        Bad{"UnknownKey", R"({"frame": 3, "ball": []})", "ball: unknown key, expected frame"},
        Bad{"UnknownKeyOfABall", of_ball(R"("range": 1)"), "balls[0].range: unknown key"},
        Bad{"NoColour", R"({"frame": 3, "balls": [{"range_m": 1}]})", R"(balls[0]: expected "colour")"},
        Bad{"UnknownColour", R"({"frame": 3, "balls": [{"colour": 18, "range_m": 1, "bearing_rad": 0}]})",
            "balls[0].colour: expected a whole number from 0 to 17 (got 18)"},
        Bad{"ColourOfText", R"({"frame": 3, "balls": [{"colour": "red"}]})", "balls[0].colour: expected"},
        Bad{"Nowhere", of_ball(R"("truncated": true)"), R"(expected "range_m" and "bearing_rad", or)"},
        Bad{"OneCamera", of_ball(R"("left_px": [1, 2])"), R"(expected "right_px")"},
        Bad{"NegativeRange", of_ball(R"("range_m": -1, "bearing_rad": 0)"), "range_m: expected a number"},
        Bad{"NullRange", of_ball(R"("range_m": null, "bearing_rad": 0)"), "range_m: expected a number"},
        Bad{"Degrees", of_ball(R"("range_m": 1, "bearing_rad": 12)"), "bearing_rad: expected a number"},
        Bad{"ThreeCoordinates", of_ball(R"("left_px": [1, 2, 3], "right_px": [0, 2])"),
            "left_px: expected a list of 2 entries (got 3)"},
        Bad{"CamerasSwapped", of_ball(R"("left_px": [100, 2], "right_px": [200, 2])"),
            "left_px: expected a column to the right of right_px's"},
        Bad{"NegativeRadius", of_ball(R"("left_px": [200, 2], "right_px": [100, 2], "left_radius_px": -3)"),
            "left_radius_px: expected a number"},
        Bad{"IndefiniteCovariance", of_ball(std::string(kPlace) + R"(, "covariance": [[1, 2], [2, 1]])"),
            "covariance: expected a symmetric matrix"},
        Bad{"LopsidedCovariance", of_ball(std::string(kPlace) + R"(, "covariance": [[1, 0.1], [0.2, 1]])"),
            "covariance: expected a symmetric matrix"},
        Bad{"NegativeVariance", of_ball(std::string(kPlace) + R"(, "covariance": [[-1, 0], [0, 1]])"),
            "covariance[0][0]: expected a number"},
        Bad{"TwoErrors",
            of_ball(std::string(kPlace) + R"(, "covariance": [[1, 0], [0, 1]], "centre_sd_px": 1)"),
            "centre_sd_px: expected no covariance beside it"},
        Bad{"FlagOfText", of_ball(std::string(kPlace) + R"(, "occluded": "yes")"),
            "occluded: expected true or false"}),
    [](const auto& test) { return test.param.kind; });

}  // namespace
}  // namespace stereobench::harness
