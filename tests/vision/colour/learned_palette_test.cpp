/// Colours that are learned from samples, and round things found by them.
#include "vision/colour/learned_palette.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"
#include "vision/observe.h"
#include "vision/outline/round_patch.h"
#include "vision/palette.h"
#include "vision/tuning/colours.h"

namespace stereobench::vision {
namespace {

/// Pixels of a colour under changing light: shaded, a little off in hue, and noisy.
std::vector<Eigen::Vector3d> shaded(const Eigen::Vector3d& bgr, std::size_t count, std::uint64_t seed) {
  painter::Dice dice(seed);
  std::vector<Eigen::Vector3d> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d noise(dice.normal(), dice.normal(), dice.normal());
    pixels.push_back((dice.uniform(0.5, 1.0) * bgr + 3.0 * noise).cwiseMax(0.0).cwiseMin(255.0));
  }
  return pixels;
}

// Law: what is not of the colour, up to a third of a sample, does not move it. Mutations: mean and
// covariance of all; darkest level of all.
TEST(LearnedColour, IsThatOfMostPixels) {
  const Eigen::Vector3d orange(20.0, 110.0, 240.0);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto pixels = shaded(orange, 300, seed);
    const LearnedColour clean = learn_colour("orange", pixels);
    for (int i = 0; i < 60; ++i) pixels.emplace_back(245.0, 250.0, 255.0);        // a highlight
    for (int i = 0; i < 60; ++i) pixels.emplace_back(80.0, 16.0 + 0.1 * i, 8.0);  // a dark blue neighbour
    const LearnedColour soiled = learn_colour("orange", pixels);
    EXPECT_LT((soiled.chromaticity - clean.chromaticity).norm(), 0.005);
    EXPECT_LT(std::abs(soiled.covariance.trace() / clean.covariance.trace() - 1.0), 0.25);
    EXPECT_NEAR(soiled.darkest_level, clean.darkest_level, 6.0);
    EXPECT_LT((clean.chromaticity - Eigen::Vector2d(240.0, 110.0) / 370.0).norm(), 0.01);
  }
}

TEST(LearnedColour, RefusesWhatHasNone) {
  const auto learn = [](const std::vector<Eigen::Vector3d>& pixels) { learn_colour("grey", pixels); };
  EXPECT_THROW(learn({}), std::invalid_argument);
  EXPECT_THROW(learn(shaded({120, 125, 118}, 100, 1)), std::invalid_argument);
  EXPECT_THROW(learn(shaded({0, 0, 9}, 100, 1)), std::invalid_argument);
  EXPECT_NO_THROW(learn(shaded({0, 0, 200}, 100, 1)));
}

// Law: a table gives what was learned back its own, nearly always, and neither grey nor black to anything.
// Mutations: the gate left out; the darkest level left out.
TEST(LearnedTable, KnowsItsOwnAndNothingElse) {
  const std::vector<Eigen::Vector3d> truths = {{20, 110, 240}, {220, 90, 30}, {30, 200, 40}, {40, 20, 225}};
  std::vector<LearnedColour> colours;
  for (std::size_t i = 0; i < truths.size(); ++i)
    colours.push_back(learn_colour("c", shaded(truths[i], 400, i)));
  const ColourTable table = table_of(colours);
  const auto classify = [&](const Eigen::Vector3d& bgr) {
    return table.classify(static_cast<std::uint8_t>(bgr[0]), static_cast<std::uint8_t>(bgr[1]),
                          static_cast<std::uint8_t>(bgr[2]));
  };
  for (std::size_t i = 0; i < truths.size(); ++i) {
    int right = 0;
    for (const Eigen::Vector3d& pixel : shaded(truths[i], 1000, 99 + i))
      right += classify(pixel) == i ? 1 : 0;
    EXPECT_GE(right, 970);
    EXPECT_EQ(classify(0.15 * truths[i]), kBackground) << "darker than any sample";
  }
  for (int level = 0; level < 256; level += 5)
    EXPECT_EQ(classify(Eigen::Vector3d::Constant(level)), kBackground);
  EXPECT_EQ(classify({200, 30, 220}), kBackground) << "a colour that nobody has learned";
  EXPECT_GT(separation(colours[0], colours[1]), kLearnedColours.gate_sds);
  EXPECT_EQ(separation(colours[0], colours[0]), 0.0);
}

/// Discs with soft edges, drawn sixteen times as large.
cv::Mat disc(const Eigen::Vector2d& centre, double radius, const cv::Scalar& bgr) {
  constexpr int kScale = 16;
  cv::Mat large(120 * kScale, 160 * kScale, CV_8UC3, cv::Scalar(200, 205, 210));
  const auto place = [](double at) { return static_cast<int>(std::lround((at + 0.5) * kScale)); };
  cv::circle(large, {place(centre.x()), place(centre.y())}, static_cast<int>(std::lround(radius * kScale)),
             bgr, cv::FILLED);
  cv::Mat picture;
  cv::resize(large, picture, {160, 120}, 0.0, 0.0, cv::INTER_AREA);
  return picture;
}

// Law: a disc is found where it is, with its radius, to a small part of a pixel; with a highlight in it as
// well. Mutation: half a step along the rays.
TEST(RoundPatch, IsMeasuredToAFractionOfAPixel) {
  const ColourTable table = table_of(std::vector{learn_colour("blue", shaded({220, 90, 30}, 400, 1))});
  painter::Dice dice(4);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d centre(dice.uniform(45.0, 115.0), dice.uniform(45.0, 75.0));
    const double radius = dice.uniform(8.0, 35.0);
    cv::Mat picture = disc(centre, radius, {220, 90, 30});
    cv::circle(picture, {static_cast<int>(centre.x() - 0.4 * radius), static_cast<int>(centre.y())},
               static_cast<int>(0.15 * radius), {250, 250, 250}, cv::FILLED);
    const auto found = find_round_patches(picture, table, 5.0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT((found[0].centre_px - centre).norm(), 0.1);
    EXPECT_NEAR(found[0].radius_px, radius, 0.12);
    EXPECT_LT(found[0].hidden_fraction, 0.06);
    EXPECT_EQ(found[0].outside_fraction, 0.0);
  }
}

// What is cut by the border, or half hidden, is measured by the arc that is seen, and said to be.
TEST(RoundPatch, SaysWhatIsCutAndHidden) {
  const ColourTable table = table_of(std::vector{learn_colour("blue", shaded({220, 90, 30}, 400, 1))});
  cv::Mat cut = disc({10.0, 60.0}, 25.0, {220, 90, 30});
  const auto found = find_round_patches(cut, table, 5.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].centre_px - Eigen::Vector2d(10.0, 60.0)).norm(), 0.5);
  EXPECT_NEAR(found[0].outside_fraction, 0.235, 0.03);  // of a disc beyond a chord 0.42 radii from its centre
  cv::Mat hidden = disc({80.0, 60.0}, 25.0, {220, 90, 30});
  cv::rectangle(hidden, {90, 20, 40, 80}, {30, 200, 40}, cv::FILLED);
  const auto other = find_round_patches(hidden, table, 5.0);
  ASSERT_EQ(other.size(), 1U);
  EXPECT_LT((other[0].centre_px - Eigen::Vector2d(80.0, 60.0)).norm(), 0.5);
  EXPECT_GT(other[0].hidden_fraction, 0.15);
}

// Balls of learned colours are triangulated as ours are. Mutation: the palette looked up in kPalette's
// table.
TEST(RoundPatch, IsTriangulatedAsAnyOutline) {
  const StereoRig rig;
  painter::Scene scene;
  scene.balls = {{{0.1, 0.05, 1.5}, 3, 0.05}};
  scene.backdrop = painter::Backdrop::kPlain;
  const PaletteColour& c = kPalette[3];
  const LearnedColour green = learn_colour(
      "green",
      shaded({static_cast<double>(c.b), static_cast<double>(c.g), static_cast<double>(c.r)}, 400, 1));
  const ColourTable table = table_of(std::vector{green});
  const auto balls = observe(painter::paint(scene, rig), rig, {.learned = &table});
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_EQ(balls[0].colour, 0);
  EXPECT_TRUE(balls[0].trusted());
  EXPECT_LT((balls[0].ball_in_camera - scene.balls[0].in_camera).norm(), 0.02);
}

}  // namespace
}  // namespace stereobench::vision
