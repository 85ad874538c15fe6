/// Causes of sightings that are off, of logs that are made up.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/verify/readers/log/mrclam_log.h"
#include "slam/models/measurement.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kFrame_ns = 100'000'000;
constexpr int kBarcode = 63, kSubject = 6;

/// A drive past one landmark, with a true pose each 0.1 s.
class SmallLog {
 public:
  explicit SmallLog(int poses) {
    log_.subjects[kBarcode] = kSubject;
    log_.landmarks_m[kSubject] = {3.0, 1.0};
    robot_ = {.subject = 1,
              .odometry_file = "Robot1_Odometry.dat",
              .sightings_file = "Robot1_Measurement.dat",
              .truth_file = "Robot1_Groundtruth.dat",
              .odometry = {},
              .sightings = {},
              .truth = {}};
    for (int i = 0; i < poses; ++i) {
      const slam::Pose pose = {0.1 * i, 0.0, 0.02 * i};
      robot_.truth.push_back({i + 1, "", i * kFrame_ns, pose});
    }
  }

  /// Adds a sighting at a pose. @param sign of its bearing @param too_far_m of its range
  void see(int pose, double sign, double too_far_m) {
    const MrclamPose& at = robot_.truth.at(static_cast<std::size_t>(pose));
    const Eigen::Vector2d seen = slam::predict_sighting(at.pose, log_.landmarks_m.at(kSubject));
    robot_.sightings.push_back({std::ssize(robot_.sightings) + 1, fmt::format("{}", pose), at.stamp_ns,
                                kBarcode, seen[0] + too_far_m, sign * seen[1]});
  }

  std::string faults() const {
    DatasetView view;
    check_sightings(view, log_, robot_, false);
    std::string lines;
    for (const Fault& fault : view.faults) lines += fmt::format("{}: {}\n", fault.file, fault.what);
    return lines;
  }

 private:
  MrclamLog log_;
  MrclamRobot robot_;
};

// Seven sightings name no cause. Mutation: no least number of sightings, or another one.
TEST(SightingCauses, NeedEightSightings) {
  for (const int count : {7, 8}) {
    SmallLog log(count);
    for (int i = 0; i < count; ++i) log.see(i, -1.0, 0.0);
    const auto named = HasSubstr("Robot1_Measurement.dat: bearings have the other sign (");
    if (count < 8)
      EXPECT_THAT(log.faults(), Not(named));
    else
      EXPECT_THAT(log.faults(), named);
  }
}

// Of sightings at the last pose, poses that come later say nothing. Where these are more than half, the
// others name no cause. Mutation: a cause may leave out what it cannot explain.
TEST(SightingCauses, NeedHalfOfTheSightings) {
  for (const int outside : {9, 10}) {
    const int inside = 18 - outside;
    SmallLog log(inside + 1);
    for (int i = 0; i < inside; ++i) log.see(i, 1.0, 0.0);
    for (int i = 0; i < outside; ++i) log.see(inside, 1.0, 2.0 + 0.3 * i);
    const auto named = HasSubstr("poses are a frame late, or sightings a frame early (");
    if (outside > inside)
      EXPECT_THAT(log.faults(), Not(named));
    else
      EXPECT_THAT(log.faults(), named);
  }
}

}  // namespace
}  // namespace stereobench::harness
