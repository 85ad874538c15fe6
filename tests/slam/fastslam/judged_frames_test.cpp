// What FastSLAM 1.0 leaves out, since it draws its poses without the frame, and that nobody misses it.
#include <gtest/gtest.h>

#include "slam/fastslam/pose_correction.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// Four landmarks around a pose that is known to some centimetres, and a frame of them in which a sighting may
// be far off.
struct JudgedScene {
  Particle particle;
  PoseBelief predicted{{0.2, -0.1, 0.3}, Eigen::Vector3d(4e-4, 1e-4, 1e-4).asDiagonal()};
  std::vector<Sighting> frame;

  explicit JudgedScene(std::uint64_t seed) {
    RandomStream random(seed, Stream::kWorld);
    const auto count = 1 + seed % 4;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Eigen::Vector2d place(4.0 * random.normal(), 4.0 * random.normal());
      const auto uses = static_cast<std::uint16_t>(10.0 * random.uniform());
      const auto contradictions = static_cast<std::uint16_t>(6.0 * random.uniform());
      particle.known.push_back(
          {{place, 1e-4 * Eigen::Matrix2d::Identity()}, {kUnknown, {uses, contradictions}}});
      const double reach = random.uniform() < 0.3 ? 0.3 : 0.01;
      const Eigen::Vector2d error(reach * random.normal(), reach * random.normal());
      const Eigen::Vector2d seen = predict_sighting(predicted.mean, place) + error;
      frame.push_back(
          {{seen, 1e-4 * Eigen::Matrix2d::Identity()}, static_cast<int>(i), kUnknown, kUnknown, 0});
    }
  }
};

struct Judged {
  std::vector<Target> targets;
  Posterior posterior;
  FilterCounters counters;
};

template <class Model>
Judged outcome(const JudgedScene& scene, Updates updates) {
  Judged result{std::vector<Target>(scene.frame.size()), {}, {}};
  result.posterior = PoseCorrection<Model>({}, updates)
                         .correct(scene.particle, scene.predicted, chord_of(scene.predicted), scene.frame,
                                  result.targets, result.counters);
  return result;
}

template <class Model>
class JudgedFrames : public ::testing::Test {};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(JudgedFrames, BothModels);

// Fates and counts are those of a frame that corrects the pose, and so is the pose wherever something was
// contradicted: then it may be read. Mutations: leaving out every landmark's correction, or that of a frame
// with contradictions.
TYPED_TEST(JudgedFrames, EndLikeThoseThatCorrectThePose) {
  int contradicted = 0;
  int relocalised = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const JudgedScene scene(seed);
    const Judged judged = outcome<TypeParam>(scene, Updates::kToJudge);
    const Judged used = outcome<TypeParam>(scene, Updates::kOneByOne);
    bool clean = true;
    for (std::size_t k = 0; k < scene.frame.size(); ++k) {
      EXPECT_EQ(judged.targets[k].outcome, used.targets[k].outcome) << seed;
      clean = clean && used.targets[k].outcome == Outcome::kUse;
    }
    EXPECT_EQ(judged.counters.gated_measurements, used.counters.gated_measurements);
    EXPECT_EQ(judged.posterior.relocalised, used.posterior.relocalised);
    relocalised += used.posterior.relocalised ? 1 : 0;
    if (clean && !used.posterior.relocalised) continue;
    ++contradicted;
    EXPECT_TRUE(near(judged.posterior.pose.mean, used.posterior.pose.mean, 0.0)) << seed;
    EXPECT_EQ(judged.posterior.pose.covariance, used.posterior.pose.covariance) << seed;
    EXPECT_EQ(judged.posterior.log_likelihood, used.posterior.log_likelihood) << seed;
  }
  EXPECT_GT(contradicted, 50);
  EXPECT_GT(relocalised, 5);
}

// To the last bit: what is left out are zeros. Mutation: noise that does not grow with the range.
TYPED_TEST(JudgedFrames, AKnownPoseIsAnUncertainOneWithoutUncertainty) {
  RandomStream random(3, Stream::kWorld);
  long repairs = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose robot{random.normal(), random.normal(), wrap_angle(3.0 * random.normal())};
    const double sd_m = std::exp(random.normal());
    const LandmarkBelief landmark{{5.0 * random.normal(), 5.0 * random.normal()},
                                  Eigen::Vector2d(sd_m * sd_m, 0.1).asDiagonal()};
    const Observation observation{{1.0, 0.2}, Eigen::Vector2d(0.01, 0.0016).asDiagonal(), 0.01};
    const PredictedMeasurement known = TypeParam().expect(robot, landmark, observation, repairs);
    const PredictedMeasurement uncertain =
        TypeParam().expect(PoseBelief{robot}, landmark, observation, repairs);
    EXPECT_EQ(known.expected, uncertain.expected);
    EXPECT_EQ(known.covariance, uncertain.covariance);
    EXPECT_EQ(known.cross, uncertain.cross);
  }
}

}  // namespace
}  // namespace stereobench::slam
