#include "slam/models/chord.h"

#include "slam/math/elementary.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

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
