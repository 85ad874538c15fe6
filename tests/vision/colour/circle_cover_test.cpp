/// What hides a thing, and what only looks as if it did.
#include "vision/colour/circle_cover.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/painter.h"
#include "vision/colour/learned_palette.h"
#include "vision/observe.h"
#include "vision/outline/round_patch.h"

namespace stereobench::vision {
namespace {

const cv::Scalar kBlue(220, 90, 30), kWhite(235, 240, 245), kGrey(120, 125, 118), kGround(70, 110, 80);

ColourTable blue_table() {
  painter::Dice dice(7);
  std::vector<Eigen::Vector3d> pixels;
  for (int i = 0; i < 400; ++i)
    pixels.push_back(dice.uniform(0.5, 1.0) * Eigen::Vector3d(kBlue[0], kBlue[1], kBlue[2]));
  return table_of(std::vector{learn_colour("blue", pixels)});
}

const Circle kBall{{80.0, 60.0}, 30.0};

/// A blue ball on the ground, and whatever is drawn on it or before it.
template <typename Draw>
cv::Mat picture_with(const Draw& draw) {
  cv::Mat picture(120, 160, CV_8UC3, kGround);
  cv::circle(picture, {80, 60}, 30, kBlue, cv::FILLED, cv::LINE_AA);
  draw(picture);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  cv::Mat noise(picture.size(), CV_8UC3);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 7);
  return picture + noise;
}

/// Only what lies on the ball is drawn.
void draw_on_ball(cv::Mat& picture, const cv::Rect& print, const cv::Scalar& colour) {
  cv::Mat disc = cv::Mat::zeros(picture.size(), CV_8UC1);
  cv::circle(disc, {80, 60}, 30, 255, cv::FILLED);
  cv::Mat(picture, print).setTo(colour, cv::Mat(disc, print));
}

// What is on a ball ends where the ball does. Mutation: no steps looked for at the circle.
TEST(HiddenShare, IsNoneBehindPrintsThatReachTheRim) {
  const ColourTable table = blue_table();
  for (const cv::Scalar& colour : {kWhite, kGrey}) {
    const cv::Mat print = picture_with([&](cv::Mat& picture) {
      draw_on_ball(picture, {92, 40, 30, 40}, colour);
    });
    EXPECT_LT(hidden_share(print, kBall, 0, table), 0.02);
  }
  EXPECT_EQ(hidden_share(picture_with([](cv::Mat&) {}), kBall, 0, table), 0.0);
}

// What is before a ball goes on beyond it. Mutation: a step anywhere along a ray taken for one at the circle.
TEST(HiddenShare, IsWhatStandsBeforeIt) {
  const ColourTable table = blue_table();
  for (const cv::Scalar& colour : {kWhite, kGrey}) {
    const cv::Mat post = picture_with([&](cv::Mat& picture) {
      cv::rectangle(picture, {92, 0, 30, 120}, colour, cv::FILLED);
    });
    EXPECT_GT(hidden_share(post, kBall, 0, table), 0.1);
    const cv::Mat lower = picture_with([&](cv::Mat& picture) {
      cv::rectangle(picture, {0, 72, 160, 48}, colour, cv::FILLED);
    });
    EXPECT_GT(hidden_share(lower, kBall, 0, table), 0.1);
  }
}

// A seam cuts a ball's patch in two, and it is found as one. Mutation: pieces left alone.
TEST(RoundPatch, IsOneAcrossASeam) {
  const cv::Mat seamed = picture_with([](cv::Mat& picture) {
    draw_on_ball(picture, {50, 59, 60, 2}, kWhite);
    draw_on_ball(picture, {79, 30, 2, 60}, kWhite);
  });
  const ColourTable table = blue_table();
  const auto found = find_outlines(seamed, {160, 120, 160.0, 79.5, 59.5}, {.learned = &table});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].centre_px - kBall.centre_px).norm(), 0.5);
  EXPECT_NEAR(found[0].radius_px, kBall.radius_px, 1.0);
  EXPECT_LT(found[0].hidden_fraction, 0.06);
}

// Boxes and leaves are not balls: a circle follows little of their edges.
TEST(RoundPatch, IsNoBoxAndNoLeaf) {
  const ColourTable table = blue_table();
  cv::Mat picture(120, 160, CV_8UC3, kGround);
  cv::rectangle(picture, {20, 20, 44, 30}, kBlue, cv::FILLED);
  cv::ellipse(picture, {110, 80}, {12, 7}, 30.0, 0.0, 360.0, kBlue, cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  for (const MeasuredOutline& outline : find_round_patches(picture, table, 5.0))
    EXPECT_GT(outline.hidden_fraction, 0.06) << outline.centre_px.transpose() << ", " << outline.radius_px;
}

// All of an oval's edge is seen, and what betrays it is how far it is from a circle. Mutation: roughness not
// asked for.
TEST(RoundPatch, IsNoFatOval) {
  const ColourTable table = blue_table();
  for (const int shorter : {24, 26, 28, 30}) {
    cv::Mat picture(120, 160, CV_8UC3, kGround);
    cv::ellipse(picture, {80, 60}, {34, shorter}, 20.0, 0.0, 360.0, kBlue, cv::FILLED, cv::LINE_AA);
    cv::GaussianBlur(picture, picture, {}, 0.7);
    for (const MeasuredOutline& outline : find_round_patches(picture, table, 5.0))
      EXPECT_GT(outline.hidden_fraction, 0.06) << shorter << ": " << outline.radius_px;
  }
}

}  // namespace
}  // namespace stereobench::vision
