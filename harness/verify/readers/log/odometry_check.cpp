#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/verify/geometry/link_statistics.h"
#include "harness/verify/readers/log/mrclam_log.h"
#include "slam/math/angles.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

/// What velocities are multiplied by where something is wrong with them.
struct VelocityFactor {
  double factor;
  const char* cause;
};
constexpr std::array kVelocityFactors = {
    VelocityFactor{1.0, ""},
    VelocityFactor{-1.0, "have the other sign"},
    VelocityFactor{100.0, "are in centimetres"},
    VelocityFactor{0.01, "are a hundredth: poses in centimetres, or hectometres"},
    VelocityFactor{slam::kDegreesPerRad, "are in degrees"},
    VelocityFactor{slam::kRadPerDegree, "are a 57th: headings in degrees, or radians taken for degrees"}};

/// The factor that is nearest to a measured one.
const VelocityFactor& factor_of(double ratio) {
  const auto off = [&](const VelocityFactor& one) {
    const double quotient = ratio / one.factor;
    return quotient > 0.0 ? std::max(quotient, 1.0 / quotient) : std::numeric_limits<double>::infinity();
  };
  const VelocityFactor* best = &kVelocityFactors.front();
  for (const VelocityFactor& one : kVelocityFactors)
    if (off(one) < off(*best)) best = &one;
  return *best;
}

void name_factor(DatasetView& view, const std::string& file, const char* what,
                 const std::vector<double>& ratios) {
  constexpr std::size_t kFewest = 8;
  if (ratios.size() < kFewest) return;
  const double ratio = median(ratios);
  const VelocityFactor& factor = factor_of(ratio);
  if (factor.factor != 1.0)
    view.faults.push_back({file, "",
                           fmt::format("{} velocities {}: {:.3g} times those of the true poses, in the "
                                       "middle of {} readings",
                                       what, factor.cause, ratio, ratios.size())});
}

}  // namespace

void check_odometry(DatasetView& view, const MrclamRobot& robot) {
  constexpr double kLeast_mps = 0.02, kLeast_radps = 0.05, kNanosecond = 1e-9;
  std::vector<double> forward, turning;
  for (std::size_t i = 0; i + 1 < robot.odometry.size(); ++i) {
    const MrclamReading &now = robot.odometry[i], &next = robot.odometry[i + 1];
    const auto from = true_pose(robot.truth, now.stamp_ns), to = true_pose(robot.truth, next.stamp_ns);
    const double lasts_s = kNanosecond * static_cast<double>(next.stamp_ns - now.stamp_ns);
    if (!from || !to || !(lasts_s > 0.0)) continue;
    const double turn_rad = slam::wrap_angle(to->heading_rad - from->heading_rad);
    const double along_rad = from->heading_rad + 0.5 * turn_rad;
    const double v_mps =
        (Eigen::Rotation2Dd(-along_rad) * Eigen::Vector2d(to->x_m - from->x_m, to->y_m - from->y_m)).x() /
        lasts_s;
    if (std::abs(v_mps) > kLeast_mps) forward.push_back(now.v_mps / v_mps);
    if (std::abs(turn_rad / lasts_s) > kLeast_radps) turning.push_back(now.w_radps * lasts_s / turn_rad);
  }
  name_factor(view, robot.odometry_file, "forward", forward);
  name_factor(view, robot.odometry_file, "angular", turning);
  if (!forward.empty())
    view.checked.push_back(fmt::format("odometry against poses ({} readings)", forward.size()));
}

}  // namespace stereobench::harness
