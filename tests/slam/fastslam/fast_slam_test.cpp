// What FastSlam adds to its parts: weights over frames, resampling that keeps together a path's end, its map
// and what was decided of the frame, and what becomes of new balls.
#include "slam/fastslam/fast_slam.h"

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

struct FastSlam1 {
  using Model = Linearised;
  static constexpr Proposal kProposal = Proposal::kMotion;
  static constexpr Updates kUpdates = Updates::kOneByOne;
};
struct FastSlam2 {
  using Model = Linearised;
  static constexpr Proposal kProposal = Proposal::kPosterior;
  static constexpr Updates kUpdates = Updates::kOneByOne;
};
struct UFastSlam {
  using Model = Unscented;
  static constexpr Proposal kProposal = Proposal::kPosterior;
  static constexpr Updates kUpdates = Updates::kOneByOne;
};
struct UFastSlamKim : UFastSlam {
  static constexpr Updates kUpdates = Updates::kAtOnce;
};

constexpr double kWay_sd_m = 0.2;

template <class Kind>
class FastSlams : public ::testing::Test {
 protected:
  using Filter = FastSlam<typename Kind::Model>;

  static Filter make(const FilterConfig& config, std::uint64_t seed = 1) {
    return {config, {}, seed, Kind::kProposal, Kind::kUpdates};
  }

  // A filter that saw a landmark ahead, and then drove towards it over a way that is poorly known.
  static Filter after_a_way(FilterConfig config, const RangeBearing& ahead, std::uint64_t seed) {
    config.odometry_noise.v_constant_mps = kWay_sd_m;
    Filter filter = make(config, seed);
    filter.update(std::vector<RangeBearing>{ahead});
    filter.predict({1.0, 0.0, 1.0});
    return filter;
  }
};
using AllKinds = ::testing::Types<FastSlam1, FastSlam2, UFastSlam, UFastSlamKim>;
TYPED_TEST_SUITE(FastSlams, AllKinds);

RangeBearing known(double range_m, double range_sd_m, int landmark_id) {
  RangeBearing seen = sighting({range_m, 0.0}, range_sd_m, 0.01);
  seen.landmark_id = landmark_id;
  return seen;
}

// The way is drawn when a second landmark is found, weighed when the first is seen again, and known from then
// on: what was found before the particles were resampled and what is found after it are as uncertain as the
// fused way. Catches ancestors that are not followed, a map or a posterior that is not copied, and weights
// that count twice.
TYPED_TEST(FastSlams, ResamplingKeepsPathsAndTheirMaps) {
  constexpr int kParticles = 6000;
  auto filter = this->after_a_way({.particles = kParticles, .resample_below = 1.0}, known(3.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
  filter.update(std::vector<RangeBearing>{known(2.0, 0.05, 1)});
  filter.update(std::vector<RangeBearing>{known(5.0, 1e-3, 3)});
  const Estimate after = filter.estimate();
  EXPECT_GE(after.counters.resamplings, 1);
  const double way_m2 = kWay_sd_m * kWay_sd_m;
  const double sightings_m2 = 2.0 * 0.05 * 0.05;  // found and seen again
  const double fused_m2 = way_m2 * sightings_m2 / (way_m2 + sightings_m2);
  const double distinct = kParticles * std::sqrt(fused_m2 / way_m2);
  ASSERT_EQ(after.landmarks.size(), 3u);
  for (const std::size_t found : {1u, 2u}) {
    EXPECT_NEAR(after.landmarks[found].covariance(0, 0) / fused_m2, 1.0, 5.0 * std::sqrt(2.0 / distinct))
        << "landmark " << after.landmarks[found].landmark_id;
  }
}

// Most particles are so far off that they take the ball for a new one, and those that recognise it outweigh
// them. Catches copies that carry on with what the particle they replace had decided.
TYPED_TEST(FastSlams, ResamplingTakesDecisionsAlong) {
  constexpr int kSeeds = 16;
  int doubled = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RangeBearing ball = sighting({3.0, 0.0}, 0.01, 0.01);
    ball.colour_class = 4;
    auto filter = this->after_a_way({.particles = 300, .resample_below = 1.0}, ball, seed);
    filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
    ball.range_m = 2.0;
    filter.update(std::vector<RangeBearing>{ball});
    doubled += filter.estimate().landmarks.size() == 2u ? 0 : 1;
  }
  EXPECT_LE(doubled, 2);
}

// Four more looks at the first landmark, no resampling: the way is known as after all of them. Catches
// weights of earlier frames that are forgotten.
TYPED_TEST(FastSlams, WeightsAreAProductOverFrames) {
  constexpr int kParticles = 6000;
  auto filter = this->after_a_way({.particles = kParticles, .resample_below = 0.0}, known(3.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{known(4.0, 1e-3, 2)});
  for (int look = 0; look < 4; ++look) filter.update(std::vector<RangeBearing>{known(2.0, 0.05, 1)});
  const double way_m2 = kWay_sd_m * kWay_sd_m;
  const double sightings_m2 = 0.05 * 0.05 * (1.0 + 1.0 / 4.0);
  const double fused_m2 = way_m2 * sightings_m2 / (way_m2 + sightings_m2);
  const double distinct = kParticles * std::sqrt(fused_m2 / way_m2);
  const Estimate after = filter.estimate();
  EXPECT_EQ(after.counters.resamplings, 0);
  EXPECT_NEAR(after.landmarks.at(1).covariance(0, 0) / fused_m2, 1.0, 5.0 * std::sqrt(2.0 / distinct));
}

// Catches particles that are drawn or weighed after a frame that none of them believed.
TYPED_TEST(FastSlams, AFrameThatNobodyBelievesIsNoFrame) {
  auto filter = this->after_a_way({.particles = 20}, known(3.0, 0.05, 1), 1);
  auto puzzled = filter;
  puzzled.update(std::vector<RangeBearing>{known(9.0, 0.05, 1)});
  EXPECT_EQ(puzzled.estimate().counters.gated_measurements, 20);
  for (auto* each : {&filter, &puzzled})
    each->update(std::vector<RangeBearing>{known(2.0, 0.05, 1), known(4.0, 0.05, 2)});
  const Estimate a = filter.estimate();
  const Estimate b = puzzled.estimate();
  EXPECT_TRUE(near(a.pose, b.pose, 0.0));
  for (const std::size_t i : {0u, 1u})
    EXPECT_TRUE(near(a.landmarks.at(i).position_m, b.landmarks.at(i).position_m, 0.0));
}

// Catches the noise of the sensor taken at its word.
TYPED_TEST(FastSlams, NoSensorIsBetterThanTheFloor) {
  auto filter = this->make({.particles = 3, .range_floor_m = 0.02, .bearing_floor_rad = 0.01});
  filter.update(std::vector<RangeBearing>{known(4.0, 0.0, 1)});
  const Eigen::Matrix2d covariance = filter.estimate().landmarks.at(0).covariance;
  EXPECT_NEAR(covariance(0, 0), 0.02 * 0.02, 1e-6);
  EXPECT_GE(covariance(1, 1), 0.99 * 16.0 * 1e-4);
}

RangeBearing ball_of(int colour, double range_m) {
  RangeBearing seen = sighting({range_m, 0.0}, 1e-3, 0.01);
  seen.colour_class = colour;
  return seen;
}

// Catches a check for doubles that is left out, and one that does not ask for the colour.
TYPED_TEST(FastSlams, TwoNewBallsOfAColourWithinHalfItsSpacingAreOne) {
  for (const int other : {4, 5}) {
    auto filter = this->make({.particles = 3, .colour_spacing_m = 10.0});
    filter.update(std::vector<RangeBearing>{ball_of(4, 3.0), ball_of(other, 4.0)});
    EXPECT_EQ(filter.estimate().landmarks.size(), other == 4 ? 1u : 2u);
    EXPECT_EQ(filter.estimate().counters.gated_measurements, other == 4 ? 3 : 0);
  }
}

// Two balls that are nearer to each other than each is known. Catches particles whose balls are mixed by
// nearness alone.
TYPED_TEST(FastSlams, BallsAreMixedWithTheirOwnColourOnly) {
  auto filter = this->after_a_way({.particles = 6000, .colour_spacing_m = 10.0}, known(9.0, 0.05, 1), 1);
  filter.update(std::vector<RangeBearing>{ball_of(4, 3.0), ball_of(5, 3.2)});
  const Estimate after = filter.estimate();
  ASSERT_EQ(after.landmarks.size(), 3u);
  for (const std::size_t i : {1u, 2u}) {
    const double way_m2 = kWay_sd_m * kWay_sd_m;
    EXPECT_NEAR(after.landmarks[i].covariance(0, 0) / way_m2, 1.0, 5.0 * std::sqrt(2.0 / 6000.0));
  }
}

// Two particles, drawn once and then looked through at a landmark, with no more motion in between. Where they
// are follows from the mean and spread of their estimate, and their weights from the formula by hand: the
// innovation's density given the pose, S = H Sigma H' + R. Catches a determinant left out, S from the updated
// Sigma, S without Sigma or R, S with the motion's covariance, and the density at the mean in place of the
// drawn pose.
TEST(FastSlam1Weights, AreTheInnovationsDensitiesGivenTheDrawnPoses) {
  constexpr double kSd_m = 0.1;
  const FilterConfig config{.particles = 2,
                            .odometry_noise = {.v_constant_mps = kWay_sd_m},
                            .range_floor_m = 0.0,
                            .bearing_floor_rad = 0.0,
                            .resample_below = 0.0};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    LinearisedFastSlam filter(config, {}, seed, Proposal::kMotion);
    filter.update(std::vector<RangeBearing>{known(3.0, kSd_m, 1)});
    filter.predict({1.0, 0.0, 1.0});
    filter.update(std::vector<RangeBearing>{known(4.0, kSd_m, 2)});
    const Estimate drawn = filter.estimate();
    const double apart_m = std::sqrt(drawn.covariance(0, 0));
    filter.update(std::vector<RangeBearing>{known(2.1, kSd_m, 1)});
    double weights[2], sum = 0.0, mean_m = 0.0;
    for (int i = 0; i < 2; ++i) {
      const double x_m = drawn.pose.x_m + (i == 0 ? -apart_m : apart_m);
      const double range_m = 3.0 - x_m;
      const double range_variance = 2.0 * kSd_m * kSd_m;  // found and seen again
      const double bearing_variance = 0.01 * 0.01 * (std::pow(3.0 / range_m, 2) + 1.0);
      weights[i] = std::exp(-0.5 * std::pow(2.1 - range_m, 2) / range_variance) / std::sqrt(bearing_variance);
      sum += weights[i];
      mean_m += weights[i] * x_m;
    }
    const Estimate weighed = filter.estimate();
    const double effective = sum * sum / (weights[0] * weights[0] + weights[1] * weights[1]);
    EXPECT_NEAR(weighed.effective_particles, effective, 1e-9);
    EXPECT_NEAR(weighed.pose.x_m, mean_m / sum, 1e-9);
  }
}

// Poses are drawn before anything is seen: how many particles are effective after the first look follows from
// two Gaussians, the way's N(0, a^2) and the sighting's N(d, b^2), as E[w]^2 / E[w^2]. Five standard errors
// of E[w^2], the noisier of the two. Catches poses that are drawn from the posterior.
TEST(FastSlam1Weights, AreAsUnequalAsTheMotionIsUncertain) {
  constexpr int kParticles = 20000;
  const FilterConfig config{
      .particles = kParticles, .odometry_noise = {.v_constant_mps = kWay_sd_m}, .resample_below = 0.0};
  LinearisedFastSlam filter(config, {}, 1, Proposal::kMotion);
  filter.update(std::vector<RangeBearing>{known(3.0, 0.05, 1)});
  filter.predict({1.0, 0.0, 1.0});
  filter.update(std::vector<RangeBearing>{known(2.2, 0.05, 1)});
  const double a2 = kWay_sd_m * kWay_sd_m, b2 = 2.0 * (0.05 * 0.05 + 1e-6), d2 = 0.2 * 0.2;
  const auto moment = [&](int k) {  // E[w^k] for w = exp(-(x - d)^2 / 2 b^2), x ~ N(0, a^2)
    return std::sqrt(b2 / (b2 + k * a2)) * std::exp(-0.5 * k * d2 / (b2 + k * a2));
  };
  const double share = moment(1) * moment(1) / moment(2);
  const double relative_error = std::sqrt((moment(4) / (moment(2) * moment(2)) - 1.0) / kParticles);
  EXPECT_NEAR(filter.estimate().effective_particles / kParticles / share, 1.0, 5.0 * relative_error);
}

// Where it has particles enough the first filter believes what the second does: the same drive, a pose, a
// covariance and landmarks, to five standard errors of its means. A third of its particles count.
TEST(FastSlam1Weights, WithManyParticlesLeadToTheBeliefsOfFastSlam2) {
  constexpr int kParticles = 20000;
  FilterConfig config{.particles = kParticles,
                      .odometry_noise = {.v_constant_mps = 0.1, .w_constant_radps = 0.03}};
  LinearisedFastSlam one(config, {}, 1, Proposal::kMotion);
  LinearisedFastSlam two(config, {}, 2, Proposal::kPosterior);
  for (LinearisedFastSlam* filter : {&one, &two}) {
    for (int step = 0; step < 4; ++step) {
      std::vector<RangeBearing> frame;
      const Eigen::Vector2d places[] = {{3.0, 1.0}, {4.0, -2.0}};
      for (int i = 0; i < 2; ++i) {
        frame.push_back(sighting(predict_sighting({0.55 * step, 0.0, 0.0}, places[i]), 0.1, 0.05));
        frame.back().landmark_id = i;
      }
      filter->update(frame);
      filter->predict({0.5, 0.0, 1.0});
    }
  }
  const Estimate a = one.estimate(), b = two.estimate();
  const double share = 5.0 * std::sqrt(2.0 / (kParticles / 3.0));  // of a standard deviation
  const Eigen::Vector3d sd = b.covariance.diagonal().cwiseSqrt();
  EXPECT_LE(boxminus(a.pose, b.pose).cwiseQuotient(sd).cwiseAbs().maxCoeff(), share);
  EXPECT_LE((a.covariance - b.covariance).cwiseQuotient(sd * sd.transpose()).cwiseAbs().maxCoeff(),
            2.0 * share);
  for (const std::size_t i : {0u, 1u}) {
    const Eigen::Vector2d off = a.landmarks[i].position_m - b.landmarks[i].position_m;
    EXPECT_LE(off.norm() / std::sqrt(b.landmarks[i].covariance.trace()), share);
  }
}

// A sensor of a millimetre after a way of 20 cm: hardly a particle is drawn near enough to believe what it
// sees, and yet it is no outlier. Catches a gate that asks the drawn pose in place of the odometry.
TEST(FastSlam1Weights, ABadDrawIsNotTheSensorsFault) {
  LinearisedFastSlam filter({.particles = 50, .odometry_noise = {.v_constant_mps = kWay_sd_m}}, {}, 1,
                            Proposal::kMotion);
  filter.update(std::vector<RangeBearing>{known(3.0, 1e-3, 1)});
  filter.predict({1.0, 0.0, 1.0});
  filter.update(std::vector<RangeBearing>{known(2.1, 1e-3, 1)});
  EXPECT_EQ(filter.estimate().counters.gated_measurements, 0);
  EXPECT_NEAR(filter.estimate().pose.x_m, 0.9, 5.0 * kWay_sd_m / 50.0);  // the nearest of fifty
  filter.update(std::vector<RangeBearing>{known(0.1, 1e-3, 1)});
  EXPECT_EQ(filter.estimate().counters.gated_measurements, 50);
}

}  // namespace
}  // namespace stereobench::slam
