// The light source that balls share, from sums over their pixels.
#include "vision/outline/light_source.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/vision/painter.h"

namespace stereobench::vision {
namespace {

constexpr double kNoise_levels = 2.0;
constexpr double kNoise_variance = kNoise_levels * kNoise_levels;

/// A ball's pixels as sums, and what its light is.
struct Sums {
  LightColours truth = LightColours::Zero();
  LightColours products = LightColours::Zero();
  BallLight own;  ///< by these pixels alone
};

// @param ratio the light source's light over that from all around, in each channel
// @param facing what the ball's pixels face on average
Sums look_at(const Eigen::Vector3d& paint, const Eigen::Matrix3d& ratio, int pixels,
             const Eigen::Vector3d& facing, painter::Dice& dice) {
  Sums sums;
  sums.truth.row(0) = paint.transpose();
  sums.truth.bottomRows<3>() = ratio * paint.asDiagonal();
  for (int i = 0; i < pixels; ++i) {
    const Eigen::Vector3d normal =
        (facing + 0.5 * Eigen::Vector3d(dice.normal(), dice.normal(), dice.normal())).normalized();
    const Eigen::Vector4d lit(1.0, normal.x(), normal.y(), normal.z());
    const Eigen::Vector3d noise(dice.normal(), dice.normal(), dice.normal());
    const Eigen::Vector3d colour = sums.truth.transpose() * lit + kNoise_levels * noise;
    sums.own.information += lit * lit.transpose();
    sums.products += lit * colour.transpose();
  }
  sums.own.colours = sums.own.information.ldlt().solve(sums.products);
  sums.own.shows_light_source = true;
  return sums;
}

Eigen::Vector3d any_paint(painter::Dice& dice) {
  return {dice.uniform(20.0, 110.0), dice.uniform(20.0, 110.0), dice.uniform(20.0, 110.0)};
}

// Lamps of one colour, whose directions scatter about one.
Eigen::Matrix3d light_source(double scatter, painter::Dice& dice) {
  const Eigen::Vector3d direction = Eigen::Vector3d(0.4, -0.7, -0.5) +
                                    scatter * Eigen::Vector3d(dice.normal(), dice.normal(), dice.normal());
  return direction * Eigen::RowVector3d(1.0, 1.1, 1.3);
}

struct Errors {
  double own = 0.0;     ///< of the light source's light on a ball by itself, rms, levels
  double shared = 0.0;  ///< by what others tell of it as well
};

// Many balls, one of which shows few pixels that face one way.
Errors errors_under(double scatter, int balls, int pixels) {
  painter::Dice dice(7);
  Errors squares;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    LightSourcePool pool(kNoise_variance);
    for (int i = 0; i < balls; ++i)
      pool.add(
          look_at(any_paint(dice), light_source(scatter, dice), 400, -Eigen::Vector3d::UnitZ(), dice).own);
    const Sums ball =
        look_at(any_paint(dice), light_source(scatter, dice), pixels, -1.5 * Eigen::Vector3d::UnitZ(), dice);
    pool.add(ball.own);
    const auto shared = pool.without(ball.own);
    EXPECT_TRUE(shared);
    if (!shared) return squares;
    const LightColours colours = shared->colours(ball.own.information, ball.products);
    squares.own += (ball.own.colours - ball.truth).bottomRows<3>().squaredNorm();
    squares.shared += (colours - ball.truth).bottomRows<3>().squaredNorm();
  }
  return {std::sqrt(squares.own / (9.0 * kTrials)), std::sqrt(squares.shared / (9.0 * kTrials))};
}

// Mutation: the ratio of the last ball for that of all.
TEST(LightSourcePool, TellsABallsLightFarBetterThanItsFewPixelsDo) {
  const Errors errors = errors_under(0.0, 10, 60);
  EXPECT_GT(errors.own, 1.0);
  EXPECT_LT(errors.shared, 0.45 * errors.own);
}

// Many light sources, or shadows: what the others say is worth little, and a ball's own pixels stay what
// counts. Mutation: no scatter between balls.
TEST(LightSourcePool, DoesNoHarmWhereLampsDiffer) {
  for (const double scatter : {0.03, 0.1, 0.3, 1.0}) {
    const Errors errors = errors_under(scatter, 10, 60);
    EXPECT_LT(errors.shared, 1.1 * errors.own) << "scatter " << scatter;
  }
}

// Leaving a ball out is as if it had never been there. Mutation: it is added once more.
TEST(LightSourcePool, LeavesOutTheBallThatAsks) {
  painter::Dice dice(3);
  LightSourcePool others(kNoise_variance), all(kNoise_variance);
  for (int i = 0; i < 5; ++i) {
    const BallLight light =
        look_at(any_paint(dice), light_source(0.05, dice), 300, -Eigen::Vector3d::UnitZ(), dice).own;
    others.add(light);
    all.add(light);
  }
  const Sums ball = look_at({60.0, 80.0, 30.0}, light_source(0.0, dice), 40, -Eigen::Vector3d::UnitZ(), dice);
  all.add(ball.own);
  const auto with = all.without(ball.own);
  const auto never = others.without({.colours = ball.own.colours});
  ASSERT_TRUE(with && never);
  EXPECT_TRUE(with->colours(ball.own.information, ball.products)
                  .isApprox(never->colours(ball.own.information, ball.products), 1e-9));
  EXPECT_TRUE(with->direction().isApprox(never->direction(), 1e-9));
}

// Balls that are seen from their unlit side know their shades to a hundredth of a level, and nothing of what
// lights the other side. Mutations: they count; they tell their light source well enough themselves.
TEST(LightSourcePool, AsksNoBallThatShowsNoLamp) {
  painter::Dice dice(5);
  const Eigen::Vector3d ahead = -Eigen::Vector3d::UnitZ();
  Sums unlit = look_at({60.0, 80.0, 30.0}, Eigen::Matrix3d::Zero(), 5000, ahead, dice);
  unlit.own.shows_light_source = false;
  LightSourcePool pool(kNoise_variance);
  for (int i = 0; i < 3; ++i) {
    pool.add(look_at(any_paint(dice), light_source(0.0, dice), 300, ahead, dice).own);
    pool.add(unlit.own);
  }
  const auto shared = pool.without(unlit.own);
  ASSERT_TRUE(shared) << "the others know what it does not";
  const Eigen::Vector3d truth = light_source(0.0, dice).rowwise().sum();
  EXPECT_LT((shared->direction() - truth).norm(), 0.05 * truth.norm());
}

// A large ball knows its own light source far better than light sources are alike. Mutation: no least
// scatter.
TEST(LightSourcePool, LetsNoSureBallSpeakForAll) {
  painter::Dice dice(6);
  const Eigen::Vector3d ahead = -Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d usual = light_source(0.0, dice);
  LightSourcePool pool(kNoise_variance);
  for (int i = 0; i < 6; ++i) pool.add(look_at(any_paint(dice), usual, 300, ahead, dice).own);
  const Eigen::Matrix3d aside = usual + Eigen::Matrix3d::Constant(0.1);
  pool.add(look_at(any_paint(dice), aside, 20000, ahead, dice).own);
  const auto shared = pool.without(BallLight{});
  ASSERT_TRUE(shared);
  const Eigen::Vector3d off = (shared->direction() - usual.rowwise().sum()) / 3.0;
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.04);
}

// Nobody else, or a ball that tells its light source better than that. Mutation: one other ball is enough.
TEST(LightSourcePool, IsSilentWhereItIsNotNeededOrKnowsNothing) {
  painter::Dice dice(4);
  LightSourcePool pool(kNoise_variance);
  EXPECT_FALSE(pool.without(BallLight{}));
  const Eigen::Vector3d ahead = -Eigen::Vector3d::UnitZ();
  pool.add(look_at({60.0, 80.0, 30.0}, light_source(0.0, dice), 40, ahead, dice).own);
  EXPECT_FALSE(pool.without(BallLight{})) << "one ball cannot say how lamps differ";
  pool.add(BallLight{});
  EXPECT_FALSE(pool.without(BallLight{})) << "nor can one that knows nothing of its light";
  pool.add(look_at({60.0, 80.0, 30.0}, light_source(0.0, dice), 40, ahead, dice).own);
  EXPECT_TRUE(pool.without(BallLight{}));
  const BallLight bright = look_at({90.0, 80.0, 70.0}, light_source(0.0, dice), 20000, ahead, dice).own;
  pool.add(bright);
  EXPECT_FALSE(pool.without(bright));
}

}  // namespace
}  // namespace stereobench::vision
