#include "harness/dataset_import/imported_log.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/math/elementary.h"
#include "slam/models/chord.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

using Eigen::Isometry3d;

slam::Pose on_floor(const Isometry3d& world_from_robot) {
  const Eigen::Matrix3d turn = world_from_robot.linear();
  return {world_from_robot.translation().x(), world_from_robot.translation().y(),
          slam::arc_tangent(turn(1, 0), turn(0, 0))};
}

/// How far a robot's vertical axis leans.
double tilt_of(const Isometry3d& world_from_robot) {
  const Eigen::Vector3d up = world_from_robot.linear().col(2);
  return slam::arc_tangent(up.head<2>().norm(), up.z());
}

}  // namespace

ImportedLog imported_log(const std::vector<ViewFrame>& frames, const Isometry3d& body_from_robot) {
  constexpr double kUp = 0.7;  // more than half a right angle is another axis
  ImportedLog imported;
  std::optional<Isometry3d> first;
  Isometry3d kept_from_given = Isometry3d::Identity();
  for (const ViewFrame& frame : frames) {
    LogStep& step = imported.log.steps.emplace_back();
    step.stamp_ns = frame.stamp_ns[0].value();
    if (!frame.world_from_body[0]) continue;
    const Isometry3d given = *frame.world_from_body[0] * body_from_robot;
    if (!first) {
      imported.world_is_kept = given.linear()(2, 2) >= kUp;
      if (!imported.world_is_kept) kept_from_given = given.inverse();
      first = kept_from_given * given;
    }
    const Isometry3d pose = kept_from_given * given;
    step.truth = on_floor(pose);
    imported.most_height_m =
        std::max(imported.most_height_m, std::abs(pose.translation().z() - first->translation().z()));
    imported.most_tilt_rad = std::max(imported.most_tilt_rad, tilt_of(pose));
  }
  imported.log.start = imported.log.steps.front().truth.value_or(slam::Pose{});
  return imported;
}

void add_odometry_from_truth(ImportedLog& imported) {
  std::vector<LogStep>& steps = imported.log.steps;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const std::int64_t lasts_ns = steps[i].stamp_ns - steps[i - 1].stamp_ns;
    if (lasts_ns <= 0)
      throw std::runtime_error(fmt::format("frames {} and {}: expected times that rise", i - 1, i));
    const double lasts_s = static_cast<double>(lasts_ns) / static_cast<double>(kSecond_ns);
    const slam::Pose motion =
        slam::compose(slam::inverse(steps[i - 1].truth.value()), steps[i].truth.value());
    slam::Control control = slam::control_of({motion, Eigen::Matrix3d::Zero()}, lasts_s);
    imported.most_sideways_m = std::max(imported.most_sideways_m, std::abs(control.lateral_mps) * lasts_s);
    steps[i].odometry = {{control.v_mps, control.w_radps, lasts_s}};
  }
}

}  // namespace stereobench::harness
