#include "harness/experiment/filter_config.h"

#include <cmath>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

// The oracle is what it is, and filters may be told otherwise. Mutations: the true sector,
// whatever the experiment says; a sector for cameras.
TEST(FilterConfigOfAnExperiment, IsWhatFiltersAreToBelieve) {
  Experiment experiment;
  experiment.scenario.sensor = worlds::SensorKind::kOracle;
  experiment.scenario.oracle.max_range_m = 12.0;
  experiment.scenario.oracle.false_per_look = 2.0;
  EXPECT_EQ(filter_config(experiment).sector.range_m, 12.0);
  EXPECT_EQ(filter_config(experiment).sector.false_per_look, 2.0);
  experiment.believed.sector = slam::SensorSector{6.0, 0.5, 0.2, 0.1};
  EXPECT_EQ(filter_config(experiment).sector.range_m, 6.0);
  EXPECT_EQ(filter_config(experiment).sector.false_per_look, 0.1);
  experiment.scenario.sensor = worlds::SensorKind::kStereo;
  EXPECT_EQ(filter_config(experiment).sector.range_m, 0.0);
}

// Mutations seen to turn this red: what is believed not asked; a variance for a standard deviation.
TEST(FilterConfigOfAnExperiment, SaysHowUncertainTheStartIs) {
  Experiment experiment;
  EXPECT_TRUE(filter_config(experiment).start_covariance.isZero(0.0));
  experiment.scenario.start_noise = {2.0, 0.5};
  const Eigen::Vector3d variances(4.0, 4.0, 0.25);
  EXPECT_EQ(filter_config(experiment).start_covariance, Eigen::Matrix3d(variances.asDiagonal()));
  experiment.believed.start_noise = worlds::StartNoise{};
  EXPECT_TRUE(filter_config(experiment).start_covariance.isZero(0.0));
}

// Cameras do not see through walls. Mutations: a sector for known identities, too; misses
// that count; the true rig.
TEST(FilterConfigOfAnExperiment, SaysHowFarCamerasSeeWhereNothingElseTellsLandmarksApart) {
  Experiment experiment;
  experiment.scenario.sensor = worlds::SensorKind::kStereo;
  experiment.scenario.believed_rig.intrinsics.focal_px = 500.0;
  experiment.scenario.believed_rig.intrinsics.width_px = 1000;
  experiment.scenario.world.balls.resize(1);
  experiment.scenario.world.balls.front().radius_m = 0.05;
  experiment.scenario.identity = worlds::Identity::kNone;
  const slam::SensorSector sector = filter_config(experiment).sector;
  EXPECT_NEAR(sector.range_m, 5.0, 1e-12);
  EXPECT_NEAR(sector.half_angle_rad, std::atan(1.0), 1e-12);
  EXPECT_EQ(sector.miss_probability, 1.0);
}

// Mutations: the true noise in any case; none where nothing is said.
TEST(FilterConfigOfAnExperiment, TellsTheTrueOdometryUnlessAnotherIsBelieved) {
  Experiment experiment;
  experiment.scenario.odometry_noise.v_per_v = 0.25;
  EXPECT_EQ(filter_config(experiment).odometry_noise.v_per_v, 0.25);
  experiment.believed.odometry_noise = slam::OdometryNoise{.v_per_v = 0.5};
  EXPECT_EQ(filter_config(experiment).odometry_noise.v_per_v, 0.5);
}

}  // namespace
}  // namespace stereobench::harness
