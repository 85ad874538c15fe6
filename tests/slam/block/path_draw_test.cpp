// Poses that are drawn together: the law that they are drawn from.
#include "slam/block/path_draw.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/gaussian.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// A short drive past two landmarks that are known, with noise so small that everything is linear.
struct KnownLandmarks {
  Pose start{0.3, -0.2, 0.4};
  std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {1.0, 3.0}};
  std::vector<BlockFrame> frames;

  explicit KnownLandmarks(int controls) {
    RandomStream random(11, Stream::kWorld);
    Pose truth = start;
    for (int k = 0; k < 4; ++k) {
      BlockFrame frame;
      for (int i = 0; i < controls; ++i) {
        const Control control{1.0, 0.4 - 0.3 * k, 0.5};
        truth = advance(truth, control);
        long repairs = 0;
        frame.motion = Linearised().move(frame.motion, control, {4e-5, 3e-5}, repairs);
      }
      for (int j = 0; j < 2; ++j) {
        if (k == 1) continue;  // one that sees nothing
        const Eigen::Vector2d error(5e-5 * random.normal(), 2e-5 * random.normal());
        const Eigen::Vector2d seen = predict_sighting(truth, places[static_cast<std::size_t>(j)]) + error;
        frame.used.push_back({j, {seen, Eigen::Vector2d(2.5e-9, 4e-10).asDiagonal()}});
      }
      frames.push_back(frame);
    }
  }

  // The posterior of all poses at once, from noise to path and from path to sightings: another route.
  void posterior(Eigen::VectorXd& mean, Eigen::MatrixXd& covariance) const {
    const auto size = static_cast<Eigen::Index>(3 * frames.size());
    covariance = Eigen::MatrixXd::Zero(size, size);
    mean = Eigen::VectorXd::Zero(size);  // off the path without noise
    std::vector<Pose> path;
    Eigen::MatrixXd by_noise = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < size / 3; ++k) {
      const PoseBelief& motion = frames[static_cast<std::size_t>(k)].motion;
      const Pose from = k == 0 ? start : path.back();
      path.push_back(compose(from, motion.mean));
      Eigen::Matrix3d onward = Eigen::Matrix3d::Identity();
      onward.topRows<2>() = lever(from, {path.back().x_m, path.back().y_m});
      if (k > 0) by_noise.middleRows<3>(3 * k) = onward * by_noise.middleRows<3>(3 * k - 3);
      const Eigen::Matrix3d noise = follow(from, motion).covariance;
      long repairs = 0;
      by_noise.block<3, 3>(3 * k, 3 * k) = semidefinite_root<3>(noise, repairs);
    }
    covariance = by_noise * by_noise.transpose();
    for (Eigen::Index k = 0; k < size / 3; ++k) {
      for (const UsedSighting& seen : frames[static_cast<std::size_t>(k)].used) {
        const LinearSighting linear = linearise_sighting(path[static_cast<std::size_t>(k)],
                                                         places[static_cast<std::size_t>(seen.landmark)]);
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

// Mean and covariance of 20,000 paths against the posterior of all poses as one Gaussian, with motions of
// rank two (one control a step) and of rank three. Mutations: poses drawn from the filter alone and not given
// the next one; only the last coordinate of the next one used; sightings of the last step left out.
TEST(PathOfABlock, IsDrawnWithTheMomentsOfTheExactPosterior) {
  constexpr int kDraws = 20000;
  for (const int controls : {1, 3}) {
    const KnownLandmarks drive(controls);
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    drive.posterior(mean, covariance);
    RandomStream random(3, Stream::kFilter);
    long repairs = 0;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mean.size());
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(mean.size(), mean.size());
    for (int i = 0; i < kDraws; ++i) {
      const std::vector<Pose> path = draw_path(drive.start, drive.frames, drive.places, random, repairs);
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

// Simulation-based calibration (Talts et al. 2018) where each turn is off by 9 degrees and sightings are
// precise: the truth is one more draw from the posterior, so that its rank among 19 draws is uniform. 400
// worlds, the pose in the middle; chi-square with 19 degrees of freedom, one in 10^4. Mutations: motions
// linearised at what is predicted; each pose without the next; no lever.
TEST(PathOfABlock, IsDrawnFromThePosteriorWhereTurnsAreCoarse) {
  constexpr int kDraws = 19;
  constexpr double kWorlds = 400.0;
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {1.0, 3.0}};
  const Control told{1.0, 0.3, 0.5};
  std::array<std::array<double, kDraws + 1>, 3> times{};
  RandomStream random(5, Stream::kWorld);
  long repairs = 0;
  for (int world = 0; world < static_cast<int>(kWorlds); ++world) {
    Pose truth, middle;
    std::vector<BlockFrame> frames(3);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const Control real{told.v_mps + 0.05 * random.normal(), told.w_radps + 0.3 * random.normal(), 0.5};
      truth = advance(truth, real);
      if (k == 1) middle = truth;
      frames[k].motion = Linearised().move({}, told, {0.05, 0.3}, repairs);
      for (int j = 0; j < 2; ++j) {
        const Eigen::Vector2d error(2e-3 * random.normal(), 1e-3 * random.normal());
        const Eigen::Vector2d seen = predict_sighting(truth, places[static_cast<std::size_t>(j)]) + error;
        frames[k].used.push_back({j, {seen, Eigen::Vector2d(4e-6, 1e-6).asDiagonal()}});
      }
    }
    std::array<std::size_t, 3> rank{};
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d off = boxminus(draw_path({}, frames, places, random, repairs)[1], middle);
      for (std::size_t j = 0; j < 3; ++j) rank[j] += off[static_cast<Eigen::Index>(j)] < 0.0 ? 1U : 0U;
    }
    for (std::size_t j = 0; j < 3; ++j) ++times[j][rank[j]];
  }
  for (const auto& of_one : times) {
    double chi_square = 0.0;
    for (const double count : of_one)
      chi_square += std::pow(count - kWorlds / (kDraws + 1), 2) / (kWorlds / (kDraws + 1));
    EXPECT_LT(chi_square, 52.0);
  }
  EXPECT_EQ(repairs, 0);
}

}  // namespace
}  // namespace stereobench::slam
