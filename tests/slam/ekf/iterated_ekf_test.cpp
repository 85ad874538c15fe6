// The iterated EKF where a coarse odometer meets a precise sensor: as good as it claims, which EKF-SLAM is
// not.
#include <gtest/gtest.h>

#include "slam/ekf/ekf_slam.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr OdometryNoise kCoarse{0.0, 0.14, 0.0, 0.0, 0.0, 0.14};
constexpr double kRangeSd_m = 2e-4;
constexpr double kBearingSd_rad = 3e-6;

/// A ring of landmarks around a robot that drives in a circle, five to seven of them in view.
class RingDrive {
 public:
  explicit RingDrive(std::uint64_t seed)
      : odometry_(seed, Stream::kOdometry), sensor_(seed, Stream::kOracle) {}

  const Pose& truth() const { return truth_; }

  Control odometry() {
    const Control control{0.5, 0.25, 0.8};
    truth_ = advance(truth_, control);
    return perturb(control, kCoarse, odometry_);
  }

  std::vector<RangeBearing> look() {
    std::vector<RangeBearing> frame;
    for (int i = 0; i < 16; ++i) {
      const double angle = 2.0 * kPi * i / 16.0;
      const Eigen::Vector2d exact =
          predict_sighting(truth_, {3.5 * std::cos(angle), 2.0 + 3.5 * std::sin(angle)});
      if (std::abs(exact.y()) > 0.8) continue;
      frame.push_back(sighting({exact.x() + kRangeSd_m * sensor_.normal(),
                                wrap_angle(exact.y() + kBearingSd_rad * sensor_.normal())},
                               kRangeSd_m, kBearingSd_rad));
      frame.back().landmark_id = i;
    }
    return frame;
  }

 private:
  RandomStream odometry_, sensor_;
  Pose truth_{};
};

EkfSlam filter_of(Linearisation linearisation) {
  return {{.odometry_noise = kCoarse, .range_floor_m = 0.0, .bearing_floor_rad = 0.0}, {}, linearisation};
}

struct Score {
  double rms_m = 0.0;
  double nees = 0.0;  ///< at the end, a third: 1 is consistent
  FilterCounters counters;
};

/// @param seeds drives of 60 steps, more than a lap
Score drive(Linearisation linearisation, int seeds) {
  constexpr int kSteps = 60;
  Score score;
  for (int seed = 0; seed < seeds; ++seed) {
    RingDrive drive(static_cast<std::uint64_t>(seed));
    EkfSlam filter = filter_of(linearisation);
    filter.update(drive.look());
    for (int step = 0; step < kSteps; ++step) {
      filter.predict(drive.odometry());
      filter.update(drive.look());
      score.rms_m += boxminus(filter.estimate_without_map().pose, drive.truth()).head<2>().squaredNorm();
    }
    const Estimate end = filter.estimate();
    const Eigen::Vector3d error = boxminus(end.pose, drive.truth());
    score.nees += error.dot(end.covariance.ldlt().solve(error)) / (3.0 * seeds);
    score.counters += end.counters;
  }
  score.rms_m = std::sqrt(score.rms_m / (seeds * kSteps));
  return score;
}

// 60 drives: the mean of NEES / 3 has a standard deviation of 0.105 where claims are consistent, and three of
// them are allowed. Mutations: chords in the direction of their start; slopes at the prediction.
TEST(IteratedEkf, IsAsGoodAsItClaims) {
  const Score iterated = drive(Linearisation::kIterated, 60);
  EXPECT_GT(iterated.nees, 0.68);
  EXPECT_LT(iterated.nees, 1.32);
  EXPECT_LT(iterated.rms_m, 2.5 * kRangeSd_m);
  EXPECT_LE(iterated.counters.gated_measurements, 8);  // 2 of 21,000 are expected beyond the gate
  EXPECT_EQ(iterated.counters.covariance_repairs, 0);
}

// What the chord and the iterations buy.
TEST(IteratedEkf, IsTenTimesAsGoodAsTheFirstLinearisation) {
  EXPECT_GT(drive(Linearisation::kOnce, 10).rms_m, 10.0 * drive(Linearisation::kIterated, 10).rms_m);
}

// One sighting in each fifth frame is of something else: 0.3 m too far. Mutation: no gate.
TEST(IteratedEkf, LeavesOutWhatAllOthersSpeakAgainst) {
  RingDrive drive(5);
  EkfSlam filter = filter_of(Linearisation::kIterated);
  filter.update(drive.look());
  long wrong = 0;
  for (int step = 0; step < 60; ++step) {
    filter.predict(drive.odometry());
    std::vector<RangeBearing> frame = drive.look();
    if (step % 5 == 4) {
      frame[1].range_m += 0.3;
      ++wrong;
    }
    filter.update(frame);
    EXPECT_TRUE(near(filter.estimate_without_map().pose, drive.truth(), 0.005)) << step;
  }
  EXPECT_EQ(filter.estimate_without_map().counters.gated_measurements, wrong);
  EXPECT_EQ(filter.estimate_without_map().counters.refitted_frames, wrong);
}

// The lie of a kidnapper: the robot is put elsewhere, and all it sees speaks against the odometry.
TEST(IteratedEkf, FindsItselfAgainWhereAllSpeaksAgainstTheOdometry) {
  RingDrive drive(6);
  EkfSlam filter = filter_of(Linearisation::kIterated);
  filter.update(drive.look());
  for (int step = 0; step < 40; ++step) {
    filter.predict(drive.odometry());
    filter.update(drive.look());
  }
  for (int i = 0; i < 3; ++i) drive.odometry();  // of which the filter hears nothing
  for (int step = 0; step < 20; ++step) {
    filter.predict(drive.odometry());
    filter.update(drive.look());
  }
  EXPECT_TRUE(near(filter.estimate_without_map().pose, drive.truth(), 0.02));
}

}  // namespace
}  // namespace stereobench::slam
