/// What was asked of centres, measured from the detections alone. Bounds are 99 % intervals of the sample
/// size; seeds are pinned.
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/harness/detector_faults/made_up_drive.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kFrames = 5000;

/// Moments of all coordinates of all balls' errors.
struct Moments {
  double n = 0.0;
  double mean = 0.0;
  double sd = 0.0;
};

Moments moments_of(const Arrived& frames, const MadeUpDrive& drive, int coordinate) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (std::size_t ball = 0; ball < drive.perfect.size(); ++ball)
    for (const Eigen::Vector4d& error : centre_errors(frames, drive, ball)) {
      sum += error[coordinate];
      squares += error[coordinate] * error[coordinate];
      n += 1.0;
    }
  const double mean = sum / n;
  return {n, mean, std::sqrt(squares / n - mean * mean)};
}

// Mutations: the right camera given the left one's draws; the noise a variance; a bias of the other camera.
TEST(CentreNoise, HasTheStandardDeviationAndTheBiasOfEachCamera) {
  const MadeUpDrive drive = made_up_drive(kFrames);
  DetectorFaults faults;
  faults.centre_sd_px = 0.7;
  faults.centre_bias_px = {{0.3, -0.2}, {-0.4, 0.1}};
  const Arrived frames = drive_with(faults, drive).frames;
  const double asked[] = {0.3, -0.2, -0.4, 0.1};
  for (int i = 0; i < 4; ++i) {
    const Moments found = moments_of(frames, drive, i);
    EXPECT_NEAR(found.mean, asked[i], kWithin99 * 0.7 / std::sqrt(found.n)) << i;
    EXPECT_NEAR(found.sd, 0.7, kWithin99 * 0.7 / std::sqrt(2.0 * found.n)) << i;
  }
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  double n = 0.0;
  for (std::size_t ball = 0; ball < drive.perfect.size(); ++ball)
    for (const Eigen::Vector4d& error : centre_errors(frames, drive, ball)) {
      const Eigen::Vector4d noise = error - Eigen::Vector4d(0.3, -0.2, -0.4, 0.1);
      products += noise * noise.transpose();
      n += 1.0;
    }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      EXPECT_NEAR(products(i, j) / n, 0.0, kWithin99 * 0.7 * 0.7 / std::sqrt(n)) << i << j;
}

// Mutations: the tail's share of balls and not of detections; its scale squared.
TEST(CentreNoise, HasATailThatIsAShareOfTheSameNoiseMadeLarger) {
  const MadeUpDrive drive = made_up_drive(kFrames);
  DetectorFaults faults;
  faults.centre_sd_px = 0.3;
  const Arrived plain = drive_with(faults, drive).frames;
  faults.heavy_tail = {0.1, 5.0};
  const Arrived heavy = drive_with(faults, drive).frames;
  long larger = 0, all = 0;
  for (std::size_t ball = 0; ball < drive.perfect.size(); ++ball) {
    const auto before = centre_errors(plain, drive, ball);
    const auto after = centre_errors(heavy, drive, ball);
    for (std::size_t i = 0; i < kFrames; ++i, ++all) {
      if ((after[i] - before[i]).norm() < 1e-9) continue;
      EXPECT_LT((after[i] - 5.0 * before[i]).norm(), 1e-9);
      ++larger;
    }
  }
  EXPECT_TRUE(is_share(larger, all, 0.1)) << larger;
}

// Autocorrelation exp(-t / T) at each lag, and the same standard deviation from the first frame on.
// Mutations: T in frames; the process begins at 0; the noise that is added each time not made smaller.
TEST(CentreNoise, LastsAsLongAsItIsAsked) {
  constexpr double kT_s = 0.5, kStep_s = 0.1;
  const int balls = 100;
  const MadeUpDrive drive = made_up_drive(400, balls);
  DetectorFaults faults;
  faults.centre_sd_px = 0.2;
  faults.correlated_s = kT_s;
  const Arrived frames = drive_with(faults, drive).frames;
  double first = 0.0;
  for (const int lag : {1, 5}) {
    double products = 0.0, squares = 0.0, n = 0.0;
    first = 0.0;
    for (std::size_t ball = 0; ball < static_cast<std::size_t>(balls); ++ball) {
      const auto errors = centre_errors(frames, drive, ball);
      first += errors[0].squaredNorm();
      for (std::size_t i = 0; i + static_cast<std::size_t>(lag) < errors.size(); ++i) {
        products += errors[i].dot(errors[i + static_cast<std::size_t>(lag)]);
        squares += errors[i].squaredNorm();
        n += 4.0;
      }
    }
    // Bartlett: variance of a first-order process' autocorrelation at this lag
    const double a = std::exp(-kStep_s / kT_s), a2 = a * a, far = std::pow(a2, lag);
    const double sd = std::sqrt(((1.0 + a2) * (1.0 - far) / (1.0 - a2) - 2.0 * lag * far) / n);
    EXPECT_NEAR(products / squares, std::exp(-lag * kStep_s / kT_s), kWithin99 * sd) << lag;
    const double inflated = n * (1.0 - a2) / (1.0 + a2);  // independent squares worth as much
    EXPECT_NEAR(std::sqrt(squares / n), 0.2, kWithin99 * 0.2 / std::sqrt(2.0 * inflated));
  }
  EXPECT_NEAR(std::sqrt(first / (4.0 * balls)), 0.2, kWithin99 * 0.2 / std::sqrt(8.0 * balls));
}

// A ball that is seen now and then has the errors that it would have had. Mutation: time that passes only
// while a ball is seen.
TEST(CentreNoise, ThatLastsDoesNotDependOnWhenABallWasSeen) {
  const MadeUpDrive drive = made_up_drive(60);
  DetectorFaults faults;
  faults.centre_sd_px = 0.5;
  faults.correlated_s = 1.0;
  const Arrived always = drive_with(faults, drive).frames;
  const Arrived rarely = drive_with(faults, drive, 1, [&](std::size_t frame) {
                           return frame % 7 == 3 ? drive.perfect : std::vector<TracedDetection>();
                         }).frames;
  for (std::size_t i = 3; i < 60; i += 7)
    EXPECT_EQ(pixels_of(rarely[i].at(2)), pixels_of(always[i].at(2))) << i;
}

// Mutation: rounded before the noise is added.
TEST(CentreNoise, IsRoundedToMultiples) {
  const MadeUpDrive drive = made_up_drive(100);
  DetectorFaults faults;
  faults.centre_sd_px = 0.7;
  faults.quantise_px = 0.25;
  for (const auto& detections : drive_with(faults, drive).frames)
    for (const TracedDetection& detection : detections)
      for (const double coordinate : pixels_of(detection))
        EXPECT_EQ(coordinate, std::round(coordinate * 4) / 4);
}

/// Mean of e' R^-1 e / 2 of what was added, by what is stated of it.
double mean_normalised_error(const Arrived& frames, const MadeUpDrive& drive) {
  double sum = 0.0, n = 0.0;
  for (const auto& detections : frames)
    for (std::size_t i = 0; i < detections.size(); ++i) {
      const slam::RangeBearing& faulty = detections[i].seen.range_bearing;
      const slam::RangeBearing& right = drive.perfect[i].seen.range_bearing;
      const Eigen::Vector2d error(faulty.range_m - right.range_m, faulty.bearing_rad - right.bearing_rad);
      sum += 0.5 * error.dot(faulty.covariance.inverse() * error);
      n += 1.0;
    }
  return sum / n;
}

// The place follows the pixels, and a detector that states nothing of its own is consistent: with a tail,
// with rounding, and where the pixels are imagined. Mutations: range or bearing left as they were; the
// covariance of one camera; the tail left out of it; the rounding left out of it.
TEST(CentreNoise, IsStatedHonestly) {
  for (const bool has_pixels : {true, false}) {
    MadeUpDrive drive = made_up_drive(kFrames);
    for (TracedDetection& detection : drive.perfect) detection.seen.has_pixels = has_pixels;
    const double n = static_cast<double>(kFrames * drive.perfect.size());
    DetectorFaults faults;
    faults.centre_sd_px = 0.05;
    EXPECT_NEAR(mean_normalised_error(drive_with(faults, drive).frames, drive), 1.0,
                kWithin99 / std::sqrt(n));
    faults.covariance_scale = 4.0;
    EXPECT_NEAR(mean_normalised_error(drive_with(faults, drive).frames, drive), 0.25,
                0.25 * kWithin99 / std::sqrt(n));
    faults.covariance_scale = 1.0;
    faults.heavy_tail = {0.2, 3.0};
    const double fourth = 1.0 + 0.2 * (81.0 - 1.0), second = 1.0 + 0.2 * (9.0 - 1.0);
    const double sd = std::sqrt(2.0 * fourth / (second * second) - 1.0);  // of chi^2 / 2 with such a tail
    EXPECT_NEAR(mean_normalised_error(drive_with(faults, drive).frames, drive), 1.0,
                kWithin99 * sd / std::sqrt(n));
    faults.heavy_tail = {};
    faults.quantise_px = 0.08;
    EXPECT_NEAR(mean_normalised_error(drive_with(faults, drive).frames, drive), 1.0,
                kWithin99 / std::sqrt(n));
  }
}

// Mutation: always honest.
TEST(CentreNoise, IsNotStatedWhereThatIsAsked) {
  MadeUpDrive drive = made_up_drive(10);
  const Eigen::Matrix2d own = Eigen::Vector2d(1e-4, 1e-6).asDiagonal();
  for (TracedDetection& detection : drive.perfect) detection.seen.range_bearing.covariance = own;
  DetectorFaults faults;
  faults.centre_sd_px = 1.0;
  faults.covariance = StatedCovariance::kAsStated;
  for (const auto& detections : drive_with(faults, drive).frames)
    for (const TracedDetection& detection : detections)
      EXPECT_EQ(detection.seen.range_bearing.covariance, own);
  faults.covariance = StatedCovariance::kHonest;
  for (const auto& detections : drive_with(faults, drive).frames)
    for (const TracedDetection& detection : detections)
      EXPECT_GT(detection.seen.range_bearing.covariance(0, 0), own(0, 0));
}

// A detector that knows better where the ball is than its pixels say keeps that. Mutation: the place put
// where the pixels are.
TEST(CentreNoise, LeavesADetectorItsOwnEstimate) {
  constexpr double kBetter_m = 0.2;
  const MadeUpDrive drive = made_up_drive(50);
  MadeUpDrive better = drive;
  for (TracedDetection& detection : better.perfect) detection.seen.range_bearing.range_m += kBetter_m;
  DetectorFaults faults;
  faults.centre_sd_px = 0.05;
  const Arrived plain = drive_with(faults, drive).frames;
  const Arrived frames = drive_with(faults, better).frames;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t ball = 0; ball < frames[i].size(); ++ball)
      EXPECT_NEAR(frames[i][ball].seen.range_bearing.range_m,
                  plain[i][ball].seen.range_bearing.range_m + kBetter_m, 1e-4);
}

// Mutation: such a detection is handed on where it was.
TEST(CentreNoise, LosesWhatIsNoBallAheadAnyMore) {
  const MadeUpDrive drive = made_up_drive(100);
  DetectorFaults faults;
  faults.centre_bias_px = {{-1000.0, 0.0}, {0.0, 0.0}};
  const FaultyDrive faulty = drive_with(faults, drive);
  for (const auto& detections : faulty.frames) EXPECT_TRUE(detections.empty());
  EXPECT_EQ(faulty.counts, (FaultCounts{.lost = 400}));
}

}  // namespace
}  // namespace stereobench::harness
