// Noise in proportion to a control is believed in proportion to the reported one: a control that is reported
// far too small is believed to be too precise, and landmarks without names then lie beyond the gate.
#include <gtest/gtest.h>

#include "slam/filter_registry.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr double kShare = 0.14;  ///< standard deviation of the noise, of the control

/// What a precise sensor sees of some landmarks, without their names.
std::vector<RangeBearing> look(const Pose& robot) {
  std::vector<RangeBearing> seen;
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(2.5, 0.4), {3.0, -0.8}, {2.8, 1.3}, {4.0, 0.1}})
    seen.push_back(sighting(predict_sighting(robot, place), 1e-4, 1e-5));
  return seen;
}

class UnderreportedControl : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, UnderreportedControl,
                         testing::Values("iekf", "smoother", "fastslam2_block", "ufastslam_block"));

// Of 2.4 deviations too little, both in speed and in turn rate. Mutation: a search with the covariance that
// is believed, which makes new landmarks of all that is seen.
TEST_P(UnderreportedControl, LosesNoLandmark) {
  FilterConfig config;
  config.particles = 20;
  config.odometry_noise = {0.0, kShare, 0.0, 0.0, 0.0, kShare};
  config.sector = {10.0, M_PI / 2.0, 0.02, 0.001};
  Filter filter = make_filter(GetParam(), config, {}, 1);
  update(filter, look({}));
  Pose truth;
  for (int step = 0; step < 6; ++step) {
    const Control control{0.2, 0.1, 1.0};
    truth = advance(truth, control);
    const double reported = step == 3 ? 1.0 - 2.4 * kShare : 1.0;
    predict(filter, {reported * control.v_mps, reported * control.w_radps, control.duration_s});
    update(filter, look(truth));
    for (const Decision& decision : last_decisions(filter).sightings)
      EXPECT_EQ(decision.outcome, Outcome::kUse) << "step " << step;
  }
  EXPECT_EQ(estimate(filter).landmarks.size(), 4U);
  EXPECT_TRUE(near(estimate(filter).pose, truth, 1e-3));
}

}  // namespace
}  // namespace stereobench::slam
