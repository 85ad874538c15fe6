#include "harness/report/detection_picture.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

constexpr Colour kWhite = {1.0, 1.0, 1.0, 1.0};

vision::StereoPair grey_pair(int width_px, int height_px) {
  const cv::Mat grey(height_px, width_px, CV_8UC3, cv::Scalar::all(100));
  return {grey, grey.clone()};
}

vision::BallObservation ball_at(double left_x_px, double right_x_px, double y_px, double radius_px) {
  vision::BallObservation ball;
  ball.colour = 3;
  ball.left_px = {left_x_px, y_px};
  ball.right_px = {right_x_px, y_px};
  ball.left_radius_px = ball.right_radius_px = radius_px;
  ball.range_bearing.range_m = 1.25;
  return ball;
}

/// White pixels above a row in a stretch of columns: outlines, without the labels below them.
std::vector<Point> white_above(const cv::Mat& image, int row, int first_column, int columns) {
  std::vector<Point> found = pixels_of(image(cv::Rect(first_column, 0, columns, row)), kWhite, 60.0);
  for (Point& point : found) point.x_px += first_column;
  return found;
}

// Both cameras' rings have the ball's centre and radius. Catches: cameras swapped, half a pixel, radius for
// diameter.
TEST(ReportDetections, RingsLieOnTheOutlines) {
  const std::vector<vision::BallObservation> balls = {ball_at(120.0, 80.0, 90.0, 30.0)};
  const cv::Mat image = decoded(draw_detection_picture(grey_pair(320, 240), balls));
  ASSERT_EQ(image.size(), cv::Size(640, 240));
  for (const auto& [first_column, centre_px] : {std::pair{0, 120.5}, std::pair{330, 400.5}}) {
    const std::vector<Point> ring = white_above(image, 83, first_column, 290);
    ASSERT_GT(ring.size(), 50u);
    EXPECT_NEAR(mean_of(ring).x_px, centre_px, 0.25);
    for (const Point& p : ring) EXPECT_NEAR(std::hypot(p.x_px - centre_px, p.y_px - 90.5), 30.0, 1.5);
  }
}

TEST(ReportDetections, WidePairsAreScaledDownWithTheirRings) {
  const std::vector<vision::BallObservation> balls = {ball_at(600.0, 500.0, 300.0, 80.0)};
  const cv::Mat image = decoded(draw_detection_picture(grey_pair(1024, 768), balls, 1024));
  ASSERT_EQ(image.size(), cv::Size(1024, 384));
  for (const Point& p : white_above(image, 140, 0, 500)) {
    EXPECT_NEAR(std::hypot(p.x_px - 300.25, p.y_px - 150.25), 40.0, 1.5);
  }
}

// IEC 61966-2-1: 100 / 255 of light is level 168. Catches: pictures as dark as their light; light that is
// encoded twice.
TEST(ReportDetections, LightIsEncodedForDisplayOnce) {
  const vision::StereoPair light = grey_pair(64, 48);
  EXPECT_EQ(for_display(light, {}).left.at<cv::Vec3b>(5, 5), cv::Vec3b(168, 168, 168));
  EXPECT_EQ(for_display(light, {}).right.at<cv::Vec3b>(5, 5), cv::Vec3b(168, 168, 168));
  const worlds::CameraSensor encoding{.noise_sd_levels = 2.0, .encoding = worlds::Encoding::kSrgb};
  EXPECT_EQ(for_display(light, encoding).left.at<cv::Vec3b>(5, 5), cv::Vec3b(100, 100, 100));
}

// Catches: flags that are not looked at.
TEST(ReportDetections, FlaggedBallsAreDashed) {
  const auto ink = [](bool truncated, bool occluded) {
    std::vector<vision::BallObservation> balls = {ball_at(120.0, 80.0, 90.0, 30.0)};
    balls[0].truncated = truncated;
    balls[0].occluded = occluded;
    return static_cast<double>(
        white_above(decoded(draw_detection_picture(grey_pair(320, 240), balls)), 83, 0, 300).size());
  };
  EXPECT_LT(ink(true, false), 0.85 * ink(false, false));
  EXPECT_LT(ink(false, true), 0.85 * ink(false, false));
}

// Catches: colours shifted or swapped by the reduction to five bits; a label where no ball is.
TEST(ReportDetections, APictureWithoutBallsIsThePair) {
  vision::StereoPair pair = grey_pair(64, 48);
  pair.left.setTo(cv::Scalar(250, 130, 10));
  const cv::Mat image = decoded(draw_detection_picture(pair, {}));
  EXPECT_LE(cv::norm(image(cv::Rect(0, 0, 60, 48)), pair.left(cv::Rect(0, 0, 60, 48)), cv::NORM_INF), 4.0);
  EXPECT_LE(cv::norm(image(cv::Rect(68, 0, 60, 48)), pair.right(cv::Rect(0, 0, 60, 48)), cv::NORM_INF), 4.0);
}

TEST(ReportDetections, BallsThatAreNotFiniteOrOutsideAreNoCrash) {
  const std::vector<vision::BallObservation> balls = {
      ball_at(NAN, 10.0, 10.0, 5.0), ball_at(-1e9, 1e9, 1e9, 5.0), ball_at(10.0, 10.0, 10.0, NAN)};
  EXPECT_FALSE(decoded(draw_detection_picture(grey_pair(64, 48), balls)).empty());
  EXPECT_EQ(draw_detection_picture(grey_pair(64, 48), balls),
            draw_detection_picture(grey_pair(64, 48), balls));
}

TEST(ReportDetections, RefusesWhatIsNoPair) {
  EXPECT_THROW(draw_detection_picture({}, {}), std::invalid_argument);
  EXPECT_THROW(draw_detection_picture({cv::Mat(4, 4, CV_8UC1), cv::Mat(4, 4, CV_8UC1)}, {}),
               std::invalid_argument);
  EXPECT_THROW(draw_detection_picture({cv::Mat(4, 4, CV_8UC3), cv::Mat(4, 5, CV_8UC3)}, {}),
               std::invalid_argument);
  EXPECT_THROW(draw_detection_picture(grey_pair(64, 48), {}, 10), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
