#include "slam/models/chord.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

/// How long a chord is for each m/s of speed, and how that changes with the turn.
struct ChordPerSpeed {
  double per_speed_s;
  double slope;  ///< s/rad
};

/// duration sin(h) / h with h = turn / 2.
ChordPerSpeed chord_per_speed(double turn_rad, double duration_s) {
  const double half = 0.5 * turn_rad;
  if (std::abs(half) < 1e-4) return {duration_s * (1.0 - half * half / 6.0), -duration_s * half / 6.0};
  const auto [s, c] = sine_cosine(half);
  return {duration_s * s / half, 0.5 * duration_s * (c - s / half) / half};
}

}  // namespace

Eigen::Vector3d chord_between(const Pose& from, const Pose& to, double turn_rad) {
  const double direction_rad = from.heading_rad + 0.5 * turn_rad;
  const auto [s, c] = sine_cosine(direction_rad);
  const double dx = to.x_m - from.x_m;
  const double dy = to.y_m - from.y_m;
  return {c * dx + s * dy, c * dy - s * dx, turn_rad};
}

Eigen::Matrix3d chord_by_end(double direction_rad, const Eigen::Vector3d& chord) {
  const auto [s, c] = sine_cosine(direction_rad);
  Eigen::Matrix3d slope;
  slope << c, s, 0.5 * chord.y(), -s, c, -0.5 * chord.x(), 0.0, 0.0, 1.0;
  return slope;
}

Pose end_of(const Pose& from, const Eigen::Vector3d& chord) {
  const double direction_rad = from.heading_rad + 0.5 * chord.z();
  const auto [s, c] = sine_cosine(direction_rad);
  return {from.x_m + c * chord.x() - s * chord.y(), from.y_m + s * chord.x() + c * chord.y(),
          wrap_angle(from.heading_rad + chord.z())};
}

Eigen::Matrix3d end_by_chord(const Pose& from, const Eigen::Vector3d& chord) {
  const double direction_rad = from.heading_rad + 0.5 * chord.z();
  const auto [s, c] = sine_cosine(direction_rad);
  Eigen::Matrix3d slope;
  slope << c, -s, -0.5 * (s * chord.x() + c * chord.y()),  //
      s, c, 0.5 * (c * chord.x() - s * chord.y()),         //
      0.0, 0.0, 1.0;
  return slope;
}

Control control_of(const PoseBelief& start_from_end, double duration_s) {
  const auto [chord, covariance] = chord_of(start_from_end);
  const auto [per_speed_s, slope] = chord_per_speed(chord.z(), duration_s);
  const Eigen::Vector2d speeds = chord.head<2>() / per_speed_s;
  Eigen::Matrix3d by_chord =
      Eigen::Vector3d(1.0 / per_speed_s, 1.0 / per_speed_s, 1.0 / duration_s).asDiagonal();
  by_chord.topRightCorner<2, 1>() = -speeds * slope / per_speed_s;
  return {.v_mps = speeds.x(),
          .w_radps = chord.z() / duration_s,
          .duration_s = duration_s,
          .lateral_mps = speeds.y(),
          .covariance = by_chord * covariance * by_chord.transpose()};
}

PoseBelief motion_of(const Control& control) {
  const double turn_rad = control.w_radps * control.duration_s;
  const auto [per_speed_s, slope] = chord_per_speed(turn_rad, control.duration_s);
  const Eigen::Vector2d speeds(control.v_mps, control.lateral_mps);
  const Eigen::Vector3d chord(speeds.x() * per_speed_s, speeds.y() * per_speed_s, turn_rad);
  Eigen::Matrix3d by_velocities = Eigen::Vector3d(per_speed_s, per_speed_s, control.duration_s).asDiagonal();
  by_velocities.topRightCorner<2, 1>() = speeds * slope * control.duration_s;
  const Eigen::Matrix3d slopes = end_by_chord({}, chord) * by_velocities;
  const Eigen::Matrix3d covariance = control.covariance.value_or(Eigen::Matrix3d::Zero());
  return {end_of({}, chord), slopes * covariance * slopes.transpose()};
}

ChordBelief chord_of(const PoseBelief& start_from_end) {
  const Pose& end = start_from_end.mean;
  const Eigen::Vector3d mean = chord_between({}, end, end.heading_rad);
  const Eigen::Matrix3d slope = chord_by_end(0.5 * end.heading_rad, mean);
  return {mean, slope * start_from_end.covariance * slope.transpose()};
}

ChordBelief chord_with_slack(const PoseBelief& start_from_end) {
  ChordBelief chord = chord_of(start_from_end);
  chord.covariance(1, 1) += kAcrossShare * kAcrossShare * chord.covariance.topLeftCorner<2, 2>().trace();
  return chord;
}

}  // namespace stereobench::slam
