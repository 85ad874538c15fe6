// A corridor of landmarks that all look alike, every two metres on alternate sides, once around a building
// and half a lap more. When the robot comes back it may be off by a landmark or two, and any shift by two of
// them fits. What it sees must then be new until a corner tells which shift it is.
#include <map>
#include <set>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr double kLong_m = 44.0;  ///< of the longer walls, between corners
constexpr double kShort_m = 22.0;
constexpr double kTurn_m = 1.2;  ///< radius
constexpr double kView_m = 8.0;
constexpr double kViewHalf_rad = M_PI / 3.0;
constexpr double kViewRangeSd_m = 0.1;
constexpr double kViewBearingSd_rad = 0.0175;
constexpr double kCorridorStep_s = 0.5;

const OdometryNoise kCorridorOdometry{.v_per_v = 0.03, .w_per_v = 0.03, .w_per_w = 0.03};

std::vector<Control> corridor_way() {
  std::vector<Control> all;
  const auto straight = [&](double length_m) {
    all.insert(all.end(), static_cast<std::size_t>(std::lround(length_m / kCorridorStep_s)),
               {1.0, 0.0, kCorridorStep_s});
  };
  constexpr int kTurnSteps = 4;
  for (int side = 0; side < 6; ++side) {
    straight(side % 2 == 0 ? kShort_m : kLong_m);
    const double arc_m = 0.5 * M_PI * kTurn_m;
    all.insert(all.end(), kTurnSteps,
               {arc_m / (kTurnSteps * kCorridorStep_s), 0.5 * M_PI / (kTurnSteps * kCorridorStep_s),
                kCorridorStep_s});
  }
  return all;
}

/// Beside the way, two metres apart, on the right and on the left in turn.
std::vector<Eigen::Vector2d> lookalikes() {
  std::vector<Eigen::Vector2d> places;
  Pose corner;
  for (int side = 0; side < 4; ++side) {
    const double length_m = side % 2 == 0 ? kShort_m : kLong_m;
    for (double along_m = 1.0; along_m < length_m; along_m += 2.0) {
      const double left_m = static_cast<int>(along_m) % 4 == 1 ? 1.0 : -1.0;
      places.push_back(locate(corner, {std::hypot(along_m, left_m), std::atan2(left_m, along_m)}));
    }
    corner = advance(corner, {length_m, 0.0, 1.0});
    corner = advance(corner, {0.5 * M_PI * kTurn_m, 0.5 * M_PI, 1.0});
  }
  return places;
}

/// What became of a drive's sightings.
struct CorridorOutcomes {
  int right = 0;
  int wrong = 0;    ///< given to the landmark of another place
  int twice = 0;    ///< landmarks that the last map has more than once
  double nees = 0;  ///< a third of it, its mean over the second lap
};

class CorridorDrive {
 public:
  CorridorDrive(const char* name, std::uint64_t seed)
      : places_(lookalikes()),
        odometry_(seed, Stream::kOdometry),
        noise_(seed, Stream::kOracle),
        filter_(make_filter(
            name, {.odometry_noise = kCorridorOdometry, .sector = {kView_m, kViewHalf_rad, 0.0, 0.0}}, {},
            seed)) {}

  CorridorOutcomes run() {
    const std::vector<Control> way = corridor_way();
    const std::size_t lap = way.size() * 4 / 6;
    for (std::size_t k = 0; k < way.size(); ++k) {
      truth_ = advance(truth_, way[k]);
      predict(filter_, perturb(way[k], kCorridorOdometry, odometry_));
      update(filter_, look());
      note_decisions();
      const Estimate now = estimate_without_map(filter_);
      const Eigen::Vector3d off = boxminus(now.pose, truth_);
      if (k >= lap)
        outcomes_.nees +=
            off.dot(now.covariance.ldlt().solve(off)) / (3.0 * static_cast<double>(way.size() - lap));
    }
    std::multiset<int> mapped;
    for (const int origin : last_decisions(filter_).mapped) mapped.insert(place_of_[origin]);
    for (std::size_t i = 0; i < places_.size(); ++i)
      outcomes_.twice += mapped.count(static_cast<int>(i)) > 1 ? 1 : 0;
    return outcomes_;
  }

 private:
  std::vector<RangeBearing> look() {
    std::vector<RangeBearing> seen;
    shown_.clear();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Eigen::Vector2d exact = predict_sighting(truth_, places_[i]);
      if (exact.x() > kView_m || exact.x() < 0.5 || std::abs(exact.y()) > kViewHalf_rad) continue;
      const Eigen::Vector2d off(kViewRangeSd_m * noise_.normal(), kViewBearingSd_rad * noise_.normal());
      seen.push_back(sighting(exact + off, kViewRangeSd_m, kViewBearingSd_rad));
      shown_.push_back(static_cast<int>(i));
    }
    return seen;
  }

  void note_decisions() {
    for (const int place : shown_) place_of_[given_++] = place;
    for (const Decision& decision : last_decisions(filter_).sightings) {
      if (decision.outcome != Outcome::kUse) continue;
      const bool right = place_of_[decision.origin] == place_of_[decision.sighting];
      ++(right ? outcomes_.right : outcomes_.wrong);
    }
  }

  std::vector<Eigen::Vector2d> places_;
  RandomStream odometry_, noise_;
  Filter filter_;
  Pose truth_;
  std::vector<int> shown_;
  int given_ = 0;
  std::map<int, int> place_of_;  ///< by sighting
  CorridorOutcomes outcomes_;
};

class Lookalikes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, Lookalikes, ::testing::Values("ekf", "iekf", "smoother"),
                         [](const auto& filter) { return std::string(filter.param); });

void expect_right_closures(const char* filter, std::uint64_t first, int drives) {
  CorridorOutcomes all;
  int wrong_drives = 0;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(drives); ++seed) {
    const CorridorOutcomes one = CorridorDrive(filter, seed).run();
    wrong_drives += one.wrong > 0 ? 1 : 0;
    all.right += one.right;
    all.twice += one.twice;
    all.nees += one.nees / drives;
  }
  EXPECT_EQ(wrong_drives, 0);
  EXPECT_GT(all.right, 1000 * drives);
  EXPECT_LE(all.twice, 1 + drives / 20);
  EXPECT_GT(all.nees, 0.3);
  EXPECT_LT(all.nees, 2.0);
}

// Some that once closed their loop wrongly. Mutations seen to turn this red: no pair is loose; no sighting is
// unsure; doubles are never merged; sets are not held against others that fit elsewhere; pairs of doubles
// that compete are not loose; the smoother looks for doubles in what a frame may show alone.
TEST_P(Lookalikes, AreNotTakenForEachOther) {
  expect_right_closures(GetParam(), 15, 17);
}

// Takes a minute: --gtest_also_run_disabled_tests (docs/results.md).
TEST_P(Lookalikes, DISABLED_AreNotTakenForEachOtherInTwoHundredDrives) {
  expect_right_closures(GetParam(), 0, 200);
}

}  // namespace
}  // namespace stereobench::slam
