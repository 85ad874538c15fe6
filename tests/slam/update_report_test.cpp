// What updates say of the filter: innovations as they were expected, and who descends from whom.
#include "slam/update_report.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/fastslam/predictive_mixture.h"
#include "tests/slam/checks.h"
#include "tests/slam/tested_filters.h"

namespace stereobench::slam {
namespace {

// A lap so precise that everything is linear in what is unknown.
Drive precise_lap() {
  constexpr double kSmall = 1e-2;
  Drive world;
  world.side_m = 8.0;
  world.range_sd_m *= kSmall;
  world.bearing_sd_rad *= kSmall;
  world.odometry_noise = {0.05 * kSmall, 0.0, 0.0, 0.02 * kSmall, 0.0, 0.0};
  return world;
}

FilterConfig reporting(const Drive& world, int particles) {
  FilterConfig config{.particles = particles, .odometry_noise = world.odometry_noise};
  config.range_floor_m = config.bearing_floor_rad = 0.0;
  config.report_updates = true;
  return config;
}

/// Filters that report each sighting by itself.
class Reports : public ::testing::TestWithParam<TestedFilter> {
 protected:
  // Drives a lap and hands each update's report over.
  template <class Take>
  Estimate drive(const Drive& world, const FilterConfig& config, std::uint64_t seed, const Take& take,
                 double claimed_variance = 1.0) const {
    Filter filter = GetParam().make(config, {}, seed);
    RandomStream odometry(seed, Stream::kOdometry);
    RandomStream sensor(seed, Stream::kOracle);
    Pose truth;
    for (const Control& control : world.controls()) {
      truth = advance(truth, control);
      predict(filter, perturb(control, world.odometry_noise, odometry));
      std::vector<RangeBearing> frame = world.look(truth, sensor);
      for (RangeBearing& seen : frame) seen.covariance *= claimed_variance;
      update(filter, frame);
      take(frame, last_update(filter));
    }
    return estimate(filter);
  }

  struct Lengths {
    double sum = 0.0;
    double count = 0.0;
    double mean() const { return sum / (2.0 * count); }
    double standard_error() const { return 1.0 / std::sqrt(count); }  // of chi-square(2) / 2
  };
  Lengths lengths(const Drive& world, int particles, std::uint64_t seed, double claimed_variance) const {
    Lengths all;
    drive(
        world, reporting(world, particles), seed,
        [&](const auto&, const UpdateReport& report) {
          for (const NormalisedInnovation& innovation : report.innovations) {
            all.sum += innovation.squared_length;
            all.count += 1.0;
          }
        },
        claimed_variance);
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(Filters, Reports,
                         ::testing::ValuesIn(tested_filters({"ekf", "iekf", "smoother", "fastslam1",
                                                             "fastslam2", "ufastslam", "fastslam2_block",
                                                             "ufastslam_block"})),
                         ::testing::PrintToStringParamName());

// A report draws nothing and repairs nothing that counts.
TEST_P(Reports, ChangeNothingAndAreEmptyUnlessAskedFor) {
  const Drive world;
  FilterConfig config = reporting(world, 20);
  const auto nothing = [](const auto&, const UpdateReport&) {};
  const Estimate with = drive(world, config, 3, nothing);
  config.report_updates = false;
  std::size_t reported = 0;
  const Estimate without = drive(world, config, 3, [&](const auto&, const UpdateReport& report) {
    reported += report.innovations.size() + report.ancestors.size();
  });
  EXPECT_EQ(reported, 0u);
  EXPECT_TRUE(near(with.pose, without.pose, 0.0));
  EXPECT_EQ(with.covariance, without.covariance);
  EXPECT_EQ(with.counters.covariance_repairs, without.counters.covariance_repairs);
  EXPECT_EQ(with.landmarks.back().position_m, without.landmarks.back().position_m);
}

// Each sighting of a landmark that was in the map, once, by its index; impossible ones in between and
// landmarks that are new have none. Mutation: the index within the frame that the filter reads.
TEST_P(Reports, NameEachSightingOfAKnownLandmarkOnce) {
  Drive world = precise_lap();
  Filter filter = GetParam().make(reporting(world, 5), {}, 1);
  RandomStream sensor(1, Stream::kOracle);
  std::vector<RangeBearing> frame = world.look({}, sensor);
  ASSERT_GE(frame.size(), 3u);
  update(filter, frame);
  EXPECT_TRUE(last_update(filter).innovations.empty());
  frame.insert(frame.begin() + 1, RangeBearing{.range_m = -1.0});
  frame.push_back(frame.back());
  frame.back().landmark_id = 1000;
  update(filter, frame);
  std::vector<int> indices;
  for (const NormalisedInnovation& one : last_update(filter).innovations) {
    indices.push_back(one.sighting);
    EXPECT_FALSE(one.refused);
  }
  std::sort(indices.begin(), indices.end());
  std::vector<int> expected = {0};
  for (int i = 2; i + 1 < static_cast<int>(frame.size()); ++i) expected.push_back(i);
  EXPECT_EQ(indices, expected);
  update(filter, {});
  EXPECT_TRUE(last_update(filter).innovations.empty());
}

// Where all is linear a filter is right, and its squared lengths have a mean of 2. Twenty laps of about 500
// sightings: five standard errors.
TEST_P(Reports, SquaredLengthsAreChiSquareWhenTheFilterIsRight) {
  Lengths all;
  const int particles = GetParam().draws_in_blocks() ? 20 : 200;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto run = lengths(precise_lap(), particles, seed, 1.0);
    all.sum += run.sum;
    all.count += run.count;
  }
  EXPECT_NEAR(all.mean(), 1.0, 5.0 * all.standard_error());
}

// What is claimed is half of the variance: one run tells, with any filter.
TEST_P(Reports, OneRunTellsThatTheNoiseIsTwiceWhatIsClaimed) {
  const auto run = lengths(precise_lap(), 200, 7, 0.5);
  EXPECT_GT(run.mean(), 1.0 + 5.0 * run.standard_error());
}

// A sighting that is off by a metre is refused, has a squared length beyond the gate, and is reported among
// the others. Mutation: leaving refused ones out.
TEST_P(Reports, TellRefusedSightingsApart) {
  const Drive world = precise_lap();
  Filter filter = GetParam().make(reporting(world, 5), {}, 1);
  RandomStream sensor(1, Stream::kOracle);
  for (int i = 0; i < 3; ++i) update(filter, world.look({}, sensor));
  std::vector<RangeBearing> frame = world.look({}, sensor);
  frame.back().range_m += 1.0;
  update(filter, frame);
  for (const NormalisedInnovation& one : last_update(filter).innovations) {
    const bool off = one.sighting + 1 == static_cast<int>(frame.size());
    EXPECT_EQ(one.refused, off);
    EXPECT_EQ(one.squared_length > 100.0, off);
  }
  EXPECT_EQ(last_update(filter).innovations.size(), frame.size());
}

// The squared lengths of a frame, each given those before it, add up to that of the frame as a whole, S of
// all sightings at once. Mutation: S smaller by a tenth.
TEST_P(Reports, SquaredLengthsOfAFrameAddUpToThatOfTheWhole) {
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {2.0, -2.0}, {5.0, 4.0}};
  const double sd = 1e-4;
  FilterConfig config{.particles = 1, .odometry_noise = {1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0}};
  config.range_floor_m = config.bearing_floor_rad = 0.0;
  config.report_updates = true;
  Filter filter = GetParam().make(config, {}, 1);
  std::vector<RangeBearing> frame;
  for (std::size_t i = 0; i < places.size(); ++i) {
    frame.push_back(sighting(predict_sighting({}, places[i]), sd, sd));
    frame.back().landmark_id = static_cast<int>(i);
  }
  update(filter, frame);  // found from a pose that is known: each landmark is as uncertain as its sighting
  const Control turn{0.0, 0.3, 1.0};
  predict(filter, turn);
  if (GetParam().name == "fastslam1") return;  // its only particle has drawn the turn
  const Pose now = advance({}, turn);
  Eigen::Matrix<double, 6, 6> s = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 3> by_pose;
  Eigen::Matrix<double, 6, 1> off;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    const Eigen::Matrix2d by_place = linearise_sighting(now, places[i]).by_landmark;
    const Eigen::Matrix2d by_place_then = linearise_sighting({}, places[i]).by_landmark;
    const Eigen::Matrix2d place = sd * sd * (by_place_then.transpose() * by_place_then).inverse();
    s.block<2, 2>(row, row) = by_place * place * by_place.transpose() + sd * sd * Eigen::Matrix2d::Identity();
    by_pose.block<2, 3>(row, 0) << -by_place, Eigen::Vector2d(0.0, -1.0);
    off.segment<2>(row) = sd * Eigen::Vector2d(1.0 + static_cast<double>(i), -2.0);
    const Eigen::Vector2d seen = predict_sighting(now, places[i]) + off.segment<2>(row);
    frame[i].range_m = seen.x();
    frame[i].bearing_rad = wrap_angle(seen.y());
  }
  s += by_pose * Eigen::Vector3d(1e-6, 0.0, 1e-6).asDiagonal() * by_pose.transpose();
  update(filter, frame);
  double sum = 0.0;
  for (const NormalisedInnovation& one : last_update(filter).innovations) sum += one.squared_length;
  EXPECT_NEAR(sum, off.dot(s.ldlt().solve(off)), 0.02 * sum);
}

// FastSLAM 1.0 knows its way by what it has drawn, and expects sightings from there: another draw, another
// expectation. The others have drawn nothing yet. Mutation: what the drawing was not yet known to.
TEST_P(Reports, ExpectationsAreThoseOfThePosesDrawn) {
  FilterConfig config{.particles = 1, .odometry_noise = {1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0}};
  config.report_updates = true;
  RangeBearing seen = sighting({3.0, 0.2}, 1e-3, 1e-3);
  seen.landmark_id = 1;
  std::vector<double> lengths;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Filter filter = GetParam().make(config, {}, seed);
    update(filter, std::vector{seen});
    predict(filter, {0.0, 0.0, 1.0});
    update(filter, std::vector{seen});
    lengths.push_back(last_update(filter).innovations.at(0).squared_length);
  }
  const auto [least, greatest] = std::minmax_element(lengths.begin(), lengths.end());
  EXPECT_EQ(*greatest > *least, GetParam().name == "fastslam1");
}

// Mutation: the ancestors of an update before.
TEST_P(Reports, AncestorsComeWithEachResampling) {
  Drive world;
  world.side_m = 8.0;
  long resamplings = 0;
  const Estimate last = drive(world, reporting(world, 30), 5, [&](const auto&, const UpdateReport& report) {
    if (report.ancestors.empty()) return;
    ++resamplings;
    ASSERT_EQ(report.ancestors.size(), 30u);
    for (const int ancestor : report.ancestors) {
      ASSERT_TRUE(ancestor >= 0 && ancestor < 30);
      EXPECT_EQ(report.ancestors[static_cast<std::size_t>(ancestor)], ancestor);  // survivors stay
    }
  });
  EXPECT_EQ(resamplings, last.counters.resamplings);
  const bool draws_late =
      GetParam().draws_in_blocks() && GetParam().draw_every == 0;  // later than this drive ends
  const bool has_particles = particle_count(GetParam().make(reporting(world, 30), {}, 1)) > 1;
  EXPECT_EQ(resamplings > 0, has_particles && !draws_late);
}

}  // namespace
}  // namespace stereobench::slam
