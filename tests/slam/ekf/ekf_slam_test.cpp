// EKF-SLAM against the textbook's matrices and against least squares, and what it makes of odd frames.
#include "slam/ekf/ekf_slam.h"

#include <algorithm>
#include <map>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/slam/checks.h"
#include "tests/slam/ekf/dense_ekf.h"

namespace stereobench::slam {
namespace {

RangeBearing known(const Eigen::Vector2d& range_bearing, int landmark_id, double range_sd_m = 0.05,
                   double bearing_sd_rad = 0.01) {
  RangeBearing seen = sighting(range_bearing, range_sd_m, bearing_sd_rad);
  seen.landmark_id = landmark_id;
  return seen;
}

// Places around the origin, and what is seen of some of them: a robot that wanders and turns about, so that
// headings and bearings cross the seam.
class Wanderer {
 public:
  explicit Wanderer(std::uint64_t seed) : random_(seed, Stream::kWorld) {
    for (int i = 0; i < 12; ++i) places_.emplace_back(6.0 * random_.normal(), 6.0 * random_.normal());
    truth_ = {random_.normal(), random_.normal(), wrap_angle(3.0 * random_.normal())};
  }

  const Pose& truth() const { return truth_; }

  Control odometry(const OdometryNoise& noise) {
    const double turn = (random_.uniform() < 0.5 ? -1.0 : 1.0) * (0.1 + 0.5 * random_.uniform());
    const Control control{random_.uniform(), turn, 0.2 + 0.5 * random_.uniform()};
    truth_ = advance(truth_, control);
    return perturb(control, noise, random_);
  }

  std::vector<RangeBearing> look() {
    std::vector<RangeBearing> frame;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Eigen::Vector2d exact = predict_sighting(truth_, places_[i]);
      if (random_.uniform() > 0.4 || exact.x() < 1.0) continue;
      const Eigen::Vector2d error(0.05 * random_.normal(), 0.01 * random_.normal());
      frame.push_back(known({exact.x() + error.x(), wrap_angle(exact.y() + error.y())}, static_cast<int>(i)));
      frame.back().covariance(0, 1) = frame.back().covariance(1, 0) = 1e-4;
    }
    return frame;
  }

 private:
  RandomStream random_;
  std::vector<Eigen::Vector2d> places_;
  Pose truth_;
};

void expect_same(const Estimate& estimate, const DenseEkf& dense, double tolerance) {
  EXPECT_TRUE(near(estimate.pose, dense.pose(), tolerance));
  EXPECT_TRUE(near(estimate.covariance, dense.covariance(), tolerance));
  for (const LandmarkEstimate& landmark : estimate.landmarks) {
    EXPECT_TRUE(near(landmark.position_m, dense.landmark(landmark.landmark_id), tolerance));
    EXPECT_TRUE(near(landmark.covariance, dense.landmark_covariance(landmark.landmark_id), tolerance));
  }
}

// Twenty drives of 40 frames, one to four controls apart: the motion that is kept apart, half of a matrix in
// a row, and roots of S are the same filter as big matrices, step by step. Bugs of public implementations
// that turn this red: the range wrapped in place of the bearing, Jacobians of the first landmark used for
// all, a gain from the updated P, P inverted (it has rank 2 after one control).
TEST(EkfSlam, IsTheTextbooksFilter) {
  const OdometryNoise noise{0.1, 0.0, 0.0, 0.05, 0.0, 0.0};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Wanderer robot(seed);
    EkfSlam filter(
        {.odometry_noise = noise, .range_floor_m = 0.0, .bearing_floor_rad = 0.0, .gate_probability = 1.0},
        robot.truth());
    DenseEkf dense(robot.truth());
    for (int step = 0; step < 40; ++step) {
      for (int i = 0; i <= step % 4; ++i) {
        const Control control = robot.odometry(noise);
        filter.predict(control);
        dense.predict(control, standard_deviations(control, noise));
      }
      const std::vector<RangeBearing> frame = robot.look();
      filter.update(frame);
      dense.update(frame);
      expect_same(filter.estimate(), dense, 1e-9);
    }
    EXPECT_EQ(filter.estimate().landmarks.size(), 12u);
    EXPECT_EQ(filter.estimate().counters.covariance_repairs, 0);
  }
}

// A short drive with noise of a ten-thousandth, as one problem of least squares: unknown are the errors of
// all controls and the places of all landmarks.
class Batch {
 public:
  Batch(std::vector<Control> odometry, std::vector<std::vector<RangeBearing>> frames, double sd)
      : odometry_(std::move(odometry)), frames_(std::move(frames)), sd_(sd) {}

  // @return the final pose and its covariance, by Gauss-Newton with numeric slopes from landmarks as given
  PoseBelief solve(const std::vector<Eigen::Vector2d>& landmarks) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(errors() + 2 * static_cast<Eigen::Index>(landmarks.size()));
    for (std::size_t j = 0; j < landmarks.size(); ++j)
      x.segment<2>(errors() + 2 * static_cast<Eigen::Index>(j)) = landmarks[j];
    Eigen::MatrixXd information;
    for (int i = 0; i < 5; ++i) {
      const Eigen::MatrixXd slope = slopes(x, [&](const Eigen::VectorXd& at) { return residuals(at); });
      information = slope.transpose() * slope;
      x -= information.ldlt().solve(slope.transpose() * residuals(x));
    }
    const Pose last = path(x).back();
    const Eigen::MatrixXd by_x =
        slopes(x, [&](const Eigen::VectorXd& at) { return boxminus(path(at).back(), last); });
    return {last, by_x * information.ldlt().solve(by_x.transpose())};
  }

 private:
  Eigen::Index errors() const { return 2 * static_cast<Eigen::Index>(odometry_.size()); }

  std::vector<Pose> path(const Eigen::VectorXd& x) const {
    std::vector<Pose> poses = {{}};
    for (std::size_t i = 0; i < odometry_.size(); ++i) {
      Control control = odometry_[i];
      control.v_mps += sd_ * x(2 * static_cast<Eigen::Index>(i));
      control.w_radps += sd_ * x(2 * static_cast<Eigen::Index>(i) + 1);
      poses.push_back(advance(poses.back(), control));
    }
    return poses;
  }

  Eigen::VectorXd residuals(const Eigen::VectorXd& x) const {
    std::vector<double> list(x.data(), x.data() + errors());
    const std::vector<Pose> poses = path(x);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (const RangeBearing& seen : frames_[i]) {
        const Eigen::Vector2d place = x.segment<2>(errors() + 2 * seen.landmark_id);
        const Eigen::Vector2d off =
            sighting_residual(predict_sighting(poses[i + 1], place), {seen.range_m, seen.bearing_rad});
        list.insert(list.end(), {off.x() / sd_, off.y() / sd_});
      }
    }
    return Eigen::Map<Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
  }

  template <class Function>
  static Eigen::MatrixXd slopes(const Eigen::VectorXd& x, const Function& function) {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd slope(function(x).size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      Eigen::VectorXd above = x, below = x;
      above(i) += kStep;
      below(i) -= kStep;
      slope.col(i) = (function(above) - function(below)) / (2.0 * kStep);
    }
    return slope;
  }

  std::vector<Control> odometry_;
  std::vector<std::vector<RangeBearing>> frames_;
  double sd_;
};

// Where noise is so small that all is linear, a filter that forgets the path ends where least squares over
// the whole path does. Catches covariances between pose and map, or between landmarks, that go missing.
TEST(EkfSlam, WithTinyNoiseIsLeastSquaresOverTheWholeDrive) {
  constexpr double kSd = 1e-4;
  const OdometryNoise noise{kSd, 0.0, 0.0, kSd, 0.0, 0.0};
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {1.0, -2.0}, {-2.0, 2.5}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomStream random(seed, Stream::kOracle);
    EkfSlam filter({.odometry_noise = noise, .range_floor_m = 0.0, .bearing_floor_rad = 0.0}, {});
    std::vector<Control> odometry;
    std::vector<std::vector<RangeBearing>> frames;
    Pose truth;
    for (int step = 0; step < 8; ++step) {
      const Control control{0.8, step % 2 == 0 ? 0.9 : -0.4, 0.5};
      truth = advance(truth, control);
      odometry.push_back(perturb(control, noise, random));
      frames.emplace_back();
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector2d exact = predict_sighting(truth, places[static_cast<std::size_t>(j)]);
        const Eigen::Vector2d error(kSd * random.normal(), kSd * random.normal());
        frames.back().push_back(known(exact + error, j, kSd, kSd));
      }
      filter.predict(odometry.back());
      filter.update(frames.back());
    }
    const PoseBelief batch = Batch(odometry, frames, kSd).solve(places);
    const Estimate filtered = filter.estimate();
    EXPECT_TRUE(near(filtered.pose, batch.mean, 0.01 * kSd));
    EXPECT_TRUE(near(filtered.covariance, batch.covariance, 0.01 * batch.covariance.norm()));
  }
}

// A hundred drives: the normalised squared error of the last pose is a chi-square with three degrees on
// average, to five standard errors. Catches noise that is taken twice or half.
TEST(EkfSlam, ErrsAsMuchAsItBelieves) {
  constexpr int kDrives = 100;
  const Drive world;
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < kDrives; ++seed) {
    RandomStream odometry(seed, Stream::kOdometry);
    RandomStream sensor(seed, Stream::kOracle);
    EkfSlam filter({.odometry_noise = world.odometry_noise}, {});
    Pose truth;
    for (const Control& control : world.controls()) {
      truth = advance(truth, control);
      filter.predict(perturb(control, world.odometry_noise, odometry));
      filter.update(world.look(truth, sensor));
    }
    const Estimate last = filter.estimate();
    const Eigen::Vector3d off = boxminus(truth, last.pose);
    mean += off.dot(last.covariance.inverse() * off) / kDrives;
  }
  EXPECT_NEAR(mean, 3.0, 5.0 * std::sqrt(6.0 / kDrives));
}

// Catches landmarks that are used in the order of the frame and not of their age.
TEST(EkfSlam, OrderInTheFrameDoesNotMatter) {
  EkfSlam one({.odometry_noise = {.v_constant_mps = 0.1, .w_constant_radps = 0.1}}, {});
  std::vector<RangeBearing> frame = {known({3.0, 0.4}, 7), known({2.0, -1.0}, 3), known({4.0, 2.0}, 5)};
  one.update(frame);
  EkfSlam other = one;
  for (int i = 0; i < 5; ++i) {
    for (EkfSlam* filter : {&one, &other}) {
      filter->predict({0.1, 0.05, 1.0});
      filter->update(frame);
      std::ranges::reverse(frame);
    }
    std::ranges::reverse(frame);
  }
  EXPECT_TRUE(near(one.estimate().pose, other.estimate().pose, 0.0));
  EXPECT_TRUE(near(one.estimate().covariance, other.estimate().covariance, 0.0));
}

// A filter that has seen two landmarks ahead and then driven towards them.
EkfSlam after_a_way(const FilterConfig& settings = {}) {
  FilterConfig config = settings;
  config.odometry_noise = {.v_constant_mps = 0.05, .w_constant_radps = 0.01};
  EkfSlam filter(config, {});
  filter.update(std::vector<RangeBearing>{known({3.0, 0.4}, 1), known({4.0, -0.4}, 2)});
  filter.predict({1.0, 0.0, 1.0});
  return filter;
}

Eigen::Vector2d seen_after_a_way(double range_m, double bearing_rad) {
  return predict_sighting({1.0, 0.0, 0.0}, locate({}, {range_m, bearing_rad}));
}

// Catches an outlier that is used, and one that is used for the map alone.
TEST(EkfSlam, AnOutlierMovesNothingAndIsCounted) {
  EkfSlam filter = after_a_way();
  const Estimate before = filter.estimate();
  filter.update(std::vector<RangeBearing>{known(seen_after_a_way(3.0, 0.4) + Eigen::Vector2d(1.0, 0.0), 1)});
  const Estimate after = filter.estimate();
  EXPECT_TRUE(near(after.pose, before.pose, 1e-15));
  EXPECT_TRUE(near(after.covariance, before.covariance, 1e-15));
  for (const std::size_t i : {0u, 1u})
    EXPECT_TRUE(near(after.landmarks[i].position_m, before.landmarks[i].position_m, 0.0));
  EXPECT_EQ(after.counters.gated_measurements, 1);
}

// The other landmark vouches for the pose, so it is this one that was wrong. Catches a count that starts
// again, and a landmark found anew that keeps its old covariances.
TEST(EkfSlam, ALandmarkContradictedAgainAndAgainIsFoundAnew) {
  EkfSlam filter = after_a_way();
  const std::vector<RangeBearing> frame = {known(seen_after_a_way(3.0, 0.4), 1),
                                           known(seen_after_a_way(6.0, -0.4), 2)};
  for (int i = 0; i < 4; ++i) filter.update(frame);
  EXPECT_TRUE(near(filter.estimate().landmarks[1].position_m, locate({}, {4.0, -0.4}), 0.1));
  filter.update(frame);
  const LandmarkEstimate moved = filter.estimate().landmarks[1];
  EXPECT_TRUE(near(moved.position_m, locate({}, {6.0, -0.4}), 0.1));
  EXPECT_GE(moved.covariance.trace(), 0.05 * 0.05);  // what one sighting tells
  EXPECT_EQ(filter.estimate().counters.gated_measurements, 5);
}

}  // namespace
}  // namespace stereobench::slam
