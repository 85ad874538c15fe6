// Poses that are drawn together: the law they are drawn from, and the filters that do so.
#include "slam/block/block_slam.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/block/backward_sampling.h"
#include "slam/block/joint_moments.h"
#include "slam/filter_registry.h"
#include "tests/slam/checks.h"
#include "tests/slam/nasty_drive.h"

namespace stereobench::slam {
namespace {

// A short drive past two landmarks that are known, with noise so small that everything is linear.
struct KnownLandmarks {
  Pose start{0.3, -0.2, 0.4};
  std::vector<BlockStep> steps;

  explicit KnownLandmarks(int controls) {
    const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {1.0, 3.0}};
    RandomStream random(11, Stream::kWorld);
    Pose truth = start;
    for (int k = 0; k < 4; ++k) {
      BlockStep step;
      for (int i = 0; i < controls; ++i) {
        const Control control{1.0, 0.4 - 0.3 * k, 0.5};
        truth = advance(truth, control);
        long repairs = 0;
        step.motion = Linearised().move(step.motion, control, {4e-5, 3e-5}, repairs);
      }
      for (const Eigen::Vector2d& place : places) {
        if (k == 1) continue;  // one that sees nothing
        const Eigen::Vector2d error(5e-5 * random.normal(), 2e-5 * random.normal());
        step.seen.push_back(
            {place, {predict_sighting(truth, place) + error, Eigen::Vector2d(2.5e-9, 4e-10).asDiagonal()}});
      }
      steps.push_back(step);
    }
  }

  // The posterior of all poses at once, from noise to path and from path to sightings: another route.
  void posterior(Eigen::VectorXd& mean, Eigen::MatrixXd& covariance) const {
    const auto size = static_cast<Eigen::Index>(3 * steps.size());
    covariance = Eigen::MatrixXd::Zero(size, size);
    mean = Eigen::VectorXd::Zero(size);  // off the path without noise
    std::vector<Pose> path;
    Eigen::MatrixXd by_noise = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < size / 3; ++k) {
      const BlockStep& step = steps[static_cast<std::size_t>(k)];
      const Pose from = k == 0 ? start : path.back();
      path.push_back(compose(from, step.motion.mean));
      Eigen::Matrix3d onward = Eigen::Matrix3d::Identity();
      onward.topRows<2>() = lever(from, {path.back().x_m, path.back().y_m});
      if (k > 0) by_noise.middleRows<3>(3 * k) = onward * by_noise.middleRows<3>(3 * k - 3);
      const Eigen::Matrix3d noise = follow(from, step.motion).covariance;
      long repairs = 0;
      by_noise.block<3, 3>(3 * k, 3 * k) = semidefinite_root<3>(noise, repairs);
    }
    covariance = by_noise * by_noise.transpose();
    for (Eigen::Index k = 0; k < size / 3; ++k) {
      for (const PlacedSighting& seen : steps[static_cast<std::size_t>(k)].seen) {
        const LinearSighting linear = linearise_sighting(path[static_cast<std::size_t>(k)], seen.place);
        Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(2, size);
        slope.middleCols<3>(3 * k) = linear.by_pose();
        const Eigen::MatrixXd s = slope * covariance * slope.transpose() + seen.observation.noise;
        const Eigen::MatrixXd gain = covariance * slope.transpose() * s.inverse();
        mean += gain * (sighting_residual(seen.observation.range_bearing, linear.expected) - slope * mean);
        covariance -= (gain * slope * covariance).eval();
      }
    }
    for (std::size_t k = 0; k < path.size(); ++k)
      mean.segment<3>(static_cast<Eigen::Index>(3 * k)) +=
          Eigen::Vector3d(path[k].x_m, path[k].y_m, path[k].heading_rad);
  }
};

template <class Model>
class Blocks : public ::testing::Test {};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(Blocks, BothModels);

// Mean and covariance of 20,000 paths against the posterior of all poses as one Gaussian, with motions of
// rank two (one control a step) and of rank three. Mutations: poses drawn from the filter alone and not given
// the next one; only the last coordinate of the next one used; sightings of the last step left out.
TYPED_TEST(Blocks, DrawPathsWithTheMomentsOfTheExactPosterior) {
  constexpr int kDraws = 20000;
  for (const int controls : {1, 3}) {
    const KnownLandmarks drive(controls);
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    drive.posterior(mean, covariance);
    RandomStream random(3, Stream::kFilter);
    PathSampler<TypeParam> sampler;
    long repairs = 0;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mean.size());
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(mean.size(), mean.size());
    for (int i = 0; i < kDraws; ++i) {
      const std::span<const Pose> path = sampler.draw(drive.start, drive.steps, random, repairs);
      Eigen::VectorXd off(mean.size());
      for (std::size_t k = 0; k < path.size(); ++k)
        off.segment<3>(static_cast<Eigen::Index>(3 * k)) << path[k].x_m, path[k].y_m, path[k].heading_rad;
      off -= mean;
      sum += off;
      squares += off * off.transpose();
    }
    const Eigen::VectorXd by_sd = covariance.diagonal().cwiseSqrt().cwiseInverse();
    const double error = 5.0 / std::sqrt(static_cast<double>(kDraws));
    EXPECT_LT((by_sd.asDiagonal() * sum / kDraws).cwiseAbs().maxCoeff(), error);
    const Eigen::MatrixXd difference =
        by_sd.asDiagonal() * (squares / kDraws - covariance) * by_sd.asDiagonal();
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), std::sqrt(2.0) * error);
    EXPECT_EQ(repairs, 0);
  }
}

FilterConfig drawing_every(int frames, int particles, const Drive& world) {
  FilterConfig config;
  config.particles = particles;
  config.draw_every = frames;
  config.gate_probability = 1.0;
  config.odometry_noise = world.odometry_noise;
  return config;
}

class BlockSlams : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, BlockSlams, ::testing::Values("fastslam2_block", "ufastslam_block"));

// Until something is drawn, a particle is an EKF over what it has seen: the same numbers by other code.
TEST(BlockSlam, IsAnEkfWhileNothingIsDrawn) {
  const Drive world;
  const FilterConfig config = drawing_every(1000, 2, world);
  const DriveScore block = drive(make_filter("fastslam2_block", config, {}, 1), world, 5);
  const DriveScore ekf = drive(make_filter("ekf", config, {}, 1), world, 5);
  EXPECT_NEAR(block.rms_m, ekf.rms_m, 1e-9);
  EXPECT_TRUE(near(block.last.pose, ekf.last.pose, 1e-9));
  EXPECT_TRUE(near(block.last.covariance, ekf.last.covariance, 1e-9));
  ASSERT_EQ(block.last.landmarks.size(), ekf.last.landmarks.size());
  for (std::size_t i = 0; i < ekf.last.landmarks.size(); ++i) {
    EXPECT_TRUE(near(block.last.landmarks[i].position_m, ekf.last.landmarks[i].position_m, 1e-8));
    EXPECT_TRUE(near(block.last.landmarks[i].covariance, ekf.last.landmarks[i].covariance, 1e-8));
    EXPECT_EQ(block.last.landmarks[i].origin, ekf.last.landmarks[i].origin);
  }
}

// With bearings that are off by 14 degrees Jacobians taken at a mean are not the slopes of what is believed.
// One particle that draws nothing is the joint Gaussian of its model; 20 seeds.
// Mutation: S without what is off the line (0.83 of the linearised error).
TEST(BlockSlam, NeedsSigmaPointsWhereBearingsArePoor) {
  const Drive world = drive_with_poor_bearings();
  double linearised = 0.0, unscented = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const FilterConfig config = drawing_every(1000, 1, world);
    linearised += drive(make_filter("fastslam2_block", config, {}, 1), world, seed).rms_m / 20.0;
    unscented += drive(make_filter("ufastslam_block", config, {}, 1), world, seed).rms_m / 20.0;
  }
  EXPECT_LT(unscented, 0.75 * linearised) << unscented << " m for " << linearised;
}

// Frames of a block that is drawn leave maps whose landmarks are right: with 300 particles the mixture over
// many blocks is the EKF's Gaussian again, as far as 300 particles go and the drive is linear. Means of
// twelve seeds, since paths that are resampled scatter by half a deviation, and one in fifty by more than
// one. Mutations: landmarks that are not refined from the path drawn; places of landmarks that are not drawn;
// a path that is drawn without the landmarks, or each pose without the next; sightings that weigh nothing;
// weights that stay when particles are drawn anew; descendants that keep the block of whom they replace.
TEST_P(BlockSlams, AgreesWithTheEkfAfterManyBlocks) {
  constexpr int kSeeds = 12;
  Drive world;
  world.side_m = 10.0;
  const DriveScore ekf = drive(make_filter("ekf", drawing_every(1, 1, world), {}, 1), world, 7);
  const Eigen::Vector3d sd = ekf.last.covariance.diagonal().cwiseSqrt();
  Eigen::Vector3d square = Eigen::Vector3d::Zero(), ratio = Eigen::Vector3d::Zero();
  double map_rms_m = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const DriveScore block =
        drive(make_filter(GetParam(), drawing_every(10, 300, world), {}, seed), world, 7);
    const Eigen::Vector3d off = boxminus(block.last.pose, ekf.last.pose).cwiseQuotient(sd);
    square += off.cwiseAbs2() / kSeeds;
    ratio += block.last.covariance.diagonal().cwiseSqrt().cwiseQuotient(sd) / kSeeds;
    map_rms_m += block.map_rms_m / kSeeds;
    EXPECT_GT(block.last.counters.resamplings, 0) << "sightings weigh nothing";
  }
  EXPECT_LT(square.maxCoeff(), 0.8) << square.transpose();
  EXPECT_GT(ratio.minCoeff(), 0.6) << ratio.transpose();
  EXPECT_LT(ratio.maxCoeff(), 1.5) << ratio.transpose();
  EXPECT_LT(map_rms_m, 2.0 * ekf.map_rms_m + 0.01);
}

// What a block ends with is a pose that was drawn, and the next starts from it without uncertainty. Mutation:
// the pose's covariance kept from one block to the next.
TEST_P(BlockSlams, StartEachBlockFromAPoseThatIsDrawn) {
  const Drive world;
  Filter filter = make_filter(GetParam(), drawing_every(2, 1, world), {}, 1);
  RangeBearing seen = sighting({4.0, 0.3}, 0.1, 0.02);
  seen.landmark_id = 1;
  for (int k = 0; k < 2; ++k) {
    predict(filter, {1.0, 0.2, 0.5});
    update(filter, std::vector{seen});
    EXPECT_GT(estimate_without_map(filter).covariance.norm(), 1e-6);
  }
  update(filter, std::vector{seen});  // from where it stands
  EXPECT_LT(estimate_without_map(filter).covariance.norm(), 1e-20);
}

// However long blocks are asked to be, what they cost is bounded. Mutation: blocks that end by their length
// alone.
TEST_P(BlockSlams, EndBlocksThatHaveAHundredLandmarks) {
  const Drive world;
  for (const int landmarks : {99, 100}) {
    Filter filter = make_filter(GetParam(), drawing_every(1000, 1, world), {}, 1);
    std::vector<RangeBearing> frame;
    for (int i = 0; i < landmarks; ++i) {
      frame.push_back(sighting({4.0, 0.03 * i - 1.5}, 0.1, 0.02));
      frame.back().landmark_id = i;
    }
    predict(filter, {1.0, 0.2, 0.5});
    update(filter, frame);
    update(filter, std::span(frame).first(1));  // from where it stands
    EXPECT_EQ(estimate_without_map(filter).covariance.norm() < 1e-20, landmarks == 100);
  }
}

double squared_length_at_the_end(const std::string& name, const Drive& world, std::uint64_t seed) {
  const Estimate last = drive(make_filter(name, drawing_every(40, 10, world), {}, seed), world, seed).last;
  Pose truth;
  for (const Control& control : world.controls()) truth = advance(truth, control);
  const Eigen::Vector3d off = boxminus(truth, last.pose);
  return off.dot(last.covariance.ldlt().solve(off));
}

// What blocks are for: after two laps with ten particles, forty seeds. The squared length of the error in
// claimed deviations is 3 for an honest filter; its median, as its mean has no bound. Ten particles are too
// few either way, and far fewer where each frame is drawn by itself.
TEST_P(BlockSlams, KnowsBetterHowWrongItIs) {
  Drive world;
  world.laps = 2;
  const std::string in_blocks = GetParam();
  const std::string frame_by_frame = in_blocks.substr(0, in_blocks.find("_block"));
  std::vector<double> each, together;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    each.push_back(squared_length_at_the_end(frame_by_frame, world, seed));
    together.push_back(squared_length_at_the_end(in_blocks, world, seed));
  }
  std::ranges::sort(each);
  std::ranges::sort(together);
  EXPECT_LT(together[20], 15.0);
  EXPECT_GT(each[20], 2.0 * together[20]);
}

// The length of blocks is theirs alone: to filters that go frame by frame it is nothing, and to those in
// blocks another length is another path.
TEST(BlockSlam, IsAFilterOfItsOwn) {
  const Drive world;
  const auto path = [&](const std::string& name, int frames, std::uint64_t seed) {
    return drive(make_filter(name, drawing_every(frames, 5, world), {}, seed), world, 1).rms_m;
  };
  for (const std::string name : {"ekf", "fastslam1", "fastslam2", "ufastslam", "ufastslam_kim"})
    EXPECT_EQ(path(name, 1, 3), path(name, 4, 3)) << name;
  for (const std::string name : {"fastslam2_block", "ufastslam_block"}) {
    EXPECT_NE(path(name, 1, 3), path(name, 4, 3)) << name;
    EXPECT_NE(path(name, 4, 3), path(name, 4, 4)) << "the seed of " << name;
  }
}

// A sighting far off is refused and counted, one without an identity counted and passed over. Mutations: no
// gate; a refused sighting that is used when the block is drawn.
TEST_P(BlockSlams, RefusesWhatCannotBe) {
  const Drive world;
  FilterConfig config = drawing_every(3, 20, world);
  config.gate_probability = 0.9999;
  const Eigen::Vector2d place(4.0, 1.0);
  Filter filter = make_filter(GetParam(), config, {}, 1);
  for (int k = 0; k < 9; ++k) {
    RangeBearing seen = sighting(predict_sighting({}, place), 0.05, 0.01);
    seen.landmark_id = 7;
    RangeBearing nameless = seen;
    nameless.landmark_id = kUnknown;
    if (k == 4) seen.range_m += 3.0;
    predict(filter, {0.0, 0.0, 0.5});
    update(filter, std::vector<RangeBearing>{seen, nameless});
    const Decisions decisions = last_decisions(filter);
    ASSERT_EQ(decisions.sightings.size(), 1U);
    EXPECT_EQ(decisions.sightings[0].outcome, k == 0   ? Outcome::kAdd
                                              : k == 4 ? Outcome::kRefuse
                                                       : Outcome::kUse);
    EXPECT_EQ(decisions.mapped, std::vector<int>{0});
  }
  const Estimate last = estimate(filter);
  EXPECT_EQ(last.counters.gated_measurements, 20);
  EXPECT_EQ(last.counters.rejected_inputs, 9);
  EXPECT_TRUE(near(last.landmarks.at(0).position_m, place, 0.05));
}

// Everything that goes wrong, with blocks that end in the middle of it.
TEST_P(BlockSlams, NeitherThrowsNorLosesANumber) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    NastyDrive drive(seed);
    drive.config.particles = 5;
    drive.config.draw_every = 2 + static_cast<int>(seed % 7);
    drive.config.report_updates = true;
    Filter filter = make_filter(GetParam(), drive.config, {}, seed);
    for (const NastyStep& step : drive.steps) {
      for (const Control& control : step.controls) predict(filter, control);
      for (const std::vector<RangeBearing>& frame : step.frames) {
        update(filter, frame);
        ASSERT_TRUE(all_finite(estimate(filter))) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace stereobench::slam
