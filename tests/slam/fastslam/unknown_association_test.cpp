// Whole drives without identities: landmarks are told apart by where they are.
#include <algorithm>
#include <array>
#include <map>

#include <gtest/gtest.h>

#include "slam/fastslam/pose_correction.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr double kHalfAngle_rad = M_PI / 2.0;

// A drive whose sightings carry nothing, some false ones among them, with the truth of each beside it.
struct Unlabelled {
  Drive world;
  double false_per_look = 0.0;
  double miss_probability = 0.0;
  bool reversed = false;
  bool labelled = false;
  bool sparse = false;  ///< landmarks outside the block and away from its corners only: 4 m apart and more

  SensorSector sector() const {
    return {world.max_range_m, kHalfAngle_rad, miss_probability, false_per_look};
  }

  FilterConfig config() const {
    return {.particles = 20, .odometry_noise = world.odometry_noise, .sector = sector()};
  }

  std::vector<RangeBearing> look(const Pose& truth, RandomStream& noise, RandomStream& chance) const {
    std::vector<RangeBearing> seen;
    for (const RangeBearing& sighting : world.look(truth, noise)) {
      if (sparse && (sighting.landmark_id < 8 || sighting.landmark_id >= 32 || sighting.landmark_id % 8 >= 4))
        continue;
      if (chance.uniform() >= miss_probability) seen.push_back(sighting);
    }
    for (double rest = false_per_look; chance.uniform() < rest; rest -= 1.0) {
      seen.push_back(sighting(
          {world.max_range_m * std::sqrt(chance.uniform()), kHalfAngle_rad * (2.0 * chance.uniform() - 1.0)},
          world.range_sd_m, world.bearing_sd_rad));
    }
    if (reversed) std::ranges::reverse(seen);
    return seen;
  }
};

struct DriveResult {
  std::vector<Pose> path;
  std::vector<std::vector<std::pair<int, int>>>
      matched;              // by frame: (true landmark seen, true one it was given to)
  std::vector<int> mapped;  // whose the landmarks of the final map are
  FilterCounters counters;
};

DriveResult drive_unlabelled(const std::string& name, const FilterConfig& config, const Unlabelled& drive,
                             std::uint64_t seed) {
  RandomStream odometry(seed, Stream::kOdometry);
  RandomStream noise(seed, Stream::kOracle);
  RandomStream chance(seed, Stream::kClutter);
  Filter filter = make_filter(name, config, {}, seed);
  Pose truth;
  std::vector<int> whose;
  DriveResult outcome;
  const auto owner = [&](int number) {
    return number < 0 ? kUnknown : whose[static_cast<std::size_t>(number)];
  };
  for (const Control& control : drive.world.controls()) {
    truth = advance(truth, control);
    predict(filter, perturb(control, drive.world.odometry_noise, odometry));
    std::vector<RangeBearing> seen = drive.look(truth, noise, chance);
    for (RangeBearing& sighting : seen) {
      whose.push_back(sighting.landmark_id);
      if (!drive.labelled) sighting.landmark_id = kUnknown;
    }
    update(filter, seen);
    outcome.path.push_back(estimate_without_map(filter).pose);
    outcome.matched.emplace_back();
    for (const Decision& decision : last_decisions(filter).sightings)
      outcome.matched.back().emplace_back(owner(decision.sighting), owner(decision.origin));
    std::ranges::sort(outcome.matched.back());
  }
  const Estimate last = estimate(filter);
  for (const LandmarkEstimate& landmark : last.landmarks) outcome.mapped.push_back(owner(landmark.origin));
  std::ranges::sort(outcome.mapped);
  outcome.counters = last.counters;
  return outcome;
}

class WithoutIdentities : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, WithoutIdentities,
                         ::testing::Values("ekf", "fastslam1", "fastslam2", "ufastslam"));

// Mutations: matches within the gate turned away, or those beyond it let in; all landmarks of a class the
// first.
TEST_P(WithoutIdentities, LandmarksFarApartAreAsGoodAsNamed) {
  Unlabelled drive{.sparse = true};
  drive.world.odometry_noise = {0.005, 0.0, 0.0, 0.002, 0.0, 0.0};
  Unlabelled named = drive;
  named.labelled = true;
  FilterConfig config = drive.config();
  config.sector = {};  // nothing but the identities differs
  config.particles = 1;
  std::array<int, 2> compared{};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    config.association = seed % 2 == 0 ? Association::kIndividual : Association::kJoint;
    const DriveResult one = drive_unlabelled(GetParam(), config, drive, seed);
    const DriveResult other = drive_unlabelled(GetParam(), config, named, seed);
    if (one.counters.gated_measurements + other.counters.gated_measurements > 0) continue;  // a rare outlier
    ++compared[seed % 2];
    EXPECT_TRUE(one.matched == other.matched) << "seed " << seed;
    EXPECT_TRUE(near(one.path.back(), other.path.back(), 1e-9)) << "seed " << seed;
  }
  EXPECT_GE(std::min(compared[0], compared[1]), 2);
}

// Mutation: the first sighting that comes gets the landmark.
TEST_P(WithoutIdentities, TheOrderOfSightingsDecidesNothing) {
  Unlabelled drive{.false_per_look = 1.0, .miss_probability = 0.1};
  Unlabelled reversed = drive;
  reversed.reversed = true;
  for (const Association association : {Association::kIndividual, Association::kJoint}) {
    FilterConfig config = drive.config();
    config.association = association;
    config.particles = 1;  // else rounding may pick another particle
    const DriveResult one = drive_unlabelled(GetParam(), config, drive, 5);
    const DriveResult other = drive_unlabelled(GetParam(), config, reversed, 5);
    EXPECT_EQ(one.mapped, other.mapped);
  }
}

// Mutation: the joint test asked where nothing competes, with a gate of its own.
TEST_P(WithoutIdentities, WhereNothingCompetesTheJointTestIsSilent) {
  const Unlabelled drive;
  FilterConfig joint = drive.config();
  joint.merge_doubles = false;
  FilterConfig individual = joint;
  individual.association = Association::kIndividual;
  const DriveResult one = drive_unlabelled(GetParam(), individual, drive, 2);
  const DriveResult other = drive_unlabelled(GetParam(), joint, drive, 2);
  EXPECT_TRUE(one.matched == other.matched);
  EXPECT_TRUE(near(one.path.back(), other.path.back(), 0.0));
  EXPECT_EQ(other.counters.joint_searches_cut, 0);
}

// Mutations: nothing loses odds; the dead stay in the report; the unseen includes what is out of view.
TEST_P(WithoutIdentities, ClutterVanishesAndLandmarksStay) {
  const Unlabelled drive{.false_per_look = 1.0, .miss_probability = 0.1};
  FilterConfig ignorant = drive.config();
  ignorant.sector = {};
  const DriveResult knowing = drive_unlabelled(GetParam(), drive.config(), drive, 3);
  const DriveResult trusting = drive_unlabelled(GetParam(), ignorant, drive, 3);
  const auto spurious = [](const DriveResult& outcome) {
    return std::ranges::count(outcome.mapped, kUnknown);
  };
  EXPECT_LE(spurious(knowing), 6);
  EXPECT_GE(spurious(trusting), 50);
  const auto landmarks = static_cast<int>(drive.world.landmarks().size());
  for (int i = 0; i < landmarks; ++i) EXPECT_LE(std::ranges::count(knowing.mapped, i), 1) << i;
  const auto real = static_cast<long>(knowing.mapped.size()) - spurious(knowing);
  EXPECT_GE(real, landmarks - 2);
}

// Mutations: any landmark trusted; a sighting of a doubtful one weighed like one of a landmark.
TEST(DoubtfulLandmarks, CorrectNoPoseAndWeighLikeNewOnes) {
  const FilterConfig config{.sector = {10.0, 1.5, 0.1, 2.0}};
  PoseCorrection<Linearised> correction(config);
  const PoseBelief predicted{{}, 0.01 * Eigen::Matrix3d::Identity()};
  const std::vector<Sighting> frame = {
      {{{4.1, 0.01}, Eigen::Vector2d(0.01, 0.0004).asDiagonal()}, kUnknown, kUnknown, 0}};
  std::vector<double> log_likelihoods;
  for (const float log_odds : {0.0F, 10.0F}) {
    Particle particle;
    Landmark landmark{{{4.0, 0.0}, 0.01 * Eigen::Matrix2d::Identity()}};
    landmark.status.log_odds = log_odds;
    particle.classed.push_back(landmark);
    std::vector<Target> targets(1);
    FilterCounters counters;
    const Posterior posterior =
        correction.correct(particle, predicted, chord_of(predicted), frame, targets, counters);
    EXPECT_EQ(targets[0].landmark, 0);
    EXPECT_EQ(targets[0].outcome, log_odds > 0.0F ? Outcome::kUse : Outcome::kConfirm);
    EXPECT_EQ(near(posterior.pose.mean, predicted.mean, 0.0), log_odds == 0.0F);
    log_likelihoods.push_back(posterior.log_likelihood);
  }
  Particle empty;
  std::vector<Target> targets(1);
  FilterCounters counters;
  EXPECT_EQ(
      correction.correct(empty, predicted, chord_of(predicted), frame, targets, counters).log_likelihood,
      log_likelihoods[0]);
  EXPECT_GT(log_likelihoods[1], log_likelihoods[0]);
}

}  // namespace
}  // namespace stereobench::slam
