#include "tests/studies/verdict_power/detector_variants.h"

#include <fmt/format.h>

#include "vision/camera/rig.h"
#include "vision/stereo/range_bearing.h"
#include "vision/stereo/sphere.h"

namespace stereobench::harness {
namespace {

constexpr double kLost = 0.03;  ///< share of balls
constexpr double kFar_m = 2.2;  ///< where balls are lost that are far
constexpr int kFirst = 4;       ///< colours of two balls, each of which all seeds see
constexpr int kSecond = 8;
constexpr const char* kConsistent = "covariance made consistent";

/// Moves a ball's centres, and its range and bearing as triangulation does.
void shift_centres(vision::BallObservation& ball, const Eigen::Vector2d& left_px,
                   const Eigen::Vector2d& right_px, const Found& found) {
  const Eigen::Isometry3d robot_from_camera = vision::robot_from_camera(found.rig);
  const auto range_and_bearing = [&] {
    const auto place =
        vision::triangulate_ball(found.rig, ball.left_px, ball.right_px, found.ball_radius_m).value();
    return vision::range_bearing(place, Eigen::Matrix3d::Identity(), robot_from_camera);
  };
  const slam::RangeBearing from = range_and_bearing();
  ball.left_px += left_px;
  ball.right_px += right_px;
  const slam::RangeBearing to = range_and_bearing();
  ball.range_bearing.range_m += to.range_m - from.range_m;
  ball.range_bearing.bearing_rad += to.bearing_rad - from.bearing_rad;
}

/// A variant that changes each ball by itself.
template <class Change>
auto each_ball(const Change& change) {
  return [change](const Found& found, slam::RandomStream& chance) {
    Observations observations = found.now;
    for (vision::BallObservation& ball : observations) change(ball, found, chance);
    return observations;
  };
}

Observations as_it_is(const Found& found, slam::RandomStream&) {
  return found.now;
}

Observations lose_some(const Found& found, slam::RandomStream& chance) {
  Observations kept;
  for (const vision::BallObservation& ball : found.now)
    if (chance.uniform() >= kLost) kept.push_back(ball);
  return kept;
}

Observations lose_far_ones(const Found& found, slam::RandomStream&) {
  Observations kept = found.now;
  std::erase_if(kept,
                [](const vision::BallObservation& ball) { return ball.range_bearing.range_m > kFar_m; });
  return kept;
}

void take_one_colour_for_another(vision::BallObservation& ball, const Found&, slam::RandomStream&) {
  if (ball.colour != kFirst && ball.colour != kSecond) return;
  ball.colour = kFirst + kSecond - ball.colour;
  ball.range_bearing.colour_class = ball.colour;
}

}  // namespace

std::vector<Variant> faulty_variants(double nis_per_degree, double coarser_belief) {
  using Ball = vision::BallObservation;
  const auto shifted = each_ball([](Ball& ball, const Found& found, slam::RandomStream&) {
    shift_centres(ball, {0.3, 0.0}, {0.0, 0.0}, found);
  });
  const auto long_ranges =
      each_ball([](Ball& ball, const Found&, slam::RandomStream&) { ball.range_bearing.range_m *= 1.01; });
  const auto covariance_times = [](double factor) {
    return each_ball(
        [factor](Ball& ball, const Found&, slam::RandomStream&) { ball.range_bearing.covariance *= factor; });
  };
  const auto late = [](const Found& found, slam::RandomStream&) { return found.before; };
  const auto distrust_odometry = [coarser_belief](slam::FilterConfig& config) {
    for (double slam::OdometryNoise::*part :
         {&slam::OdometryNoise::v_constant_mps, &slam::OdometryNoise::v_per_v,
          &slam::OdometryNoise::w_constant_radps, &slam::OdometryNoise::w_per_w})
      config.odometry_noise.*part *= coarser_belief;
  };
  return {
      {kAsItIs, {}, {}, as_it_is},
      {"centres of one camera shifted by 0.3 px",
       {"vision.disparity_rms_px", "vision.disparity_bias_px"},
       {"left (+0.3000", "right (+0.0000"},
       shifted},
      {"3 % of the balls lost",
       {"vision.recall"},
       {"and B alone 0", "  lost: they have nothing in common that chance does not explain"},
       lose_some},
      {"balls beyond 2.2 m lost",
       {"vision.recall"},
       {"and B alone 0", "at range 2.", " to 3."},
       lose_far_ones},
      {"two colours swapped",
       {"vision.misidentified"},
       {"colour 4 taken for 8", "colour 8 taken for 4", "  misidentified: ", "at colour 4 or 8 ("},
       each_ball(take_one_colour_for_another)},
      {"ranges 1 % long",
       {"vision.range_rms_m", "vision.range_bias_m"},
       {"balls, B over A: +1.000 +- 0.000 %"},
       long_ranges},
      {"a frame late", {"vision.recall", "vision.range_rms_m"}, {}, late},
      {.name = kConsistent, .metrics = {}, .says = {}, .detect = covariance_times(nis_per_degree)},
      {.name = "covariance halved",
       .metrics = {"vision.normalised_error"},
       .says = {},
       .detect = covariance_times(0.5 * nis_per_degree),
       .beside = kConsistent},
      {fmt::format("odometry believed {:g} times as noisy", coarser_belief),
       {"filters.iekf.ate_rms_m", "filters.iekf.heading_rms_rad"},
       {},
       as_it_is,
       distrust_odometry},
  };
}

Variant noisy_variant(double sd_px) {
  return {.name = fmt::format("centres off by {:g} px by chance", sd_px),
          .metrics = {},
          .says = {},
          .detect = each_ball([sd_px](vision::BallObservation& ball, const Found& found,
                                      slam::RandomStream& chance) {
            const double a = chance.normal(), b = chance.normal(), c = chance.normal(), d = chance.normal();
            shift_centres(ball, sd_px * Eigen::Vector2d(a, b), sd_px * Eigen::Vector2d(c, d), found);
          })};
}

}  // namespace stereobench::harness
