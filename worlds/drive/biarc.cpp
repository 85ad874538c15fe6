#include "worlds/drive/biarc.h"

#include <cmath>

#include <Eigen/Core>

#include "slam/math/elementary.h"

namespace stereobench::worlds {
namespace {

Eigen::Vector2d along(double heading_rad) {
  const auto [s, c] = slam::sine_cosine(heading_rad);
  return {c, s};
}

/// The arc that leaves along a tangent and ends at the tip of a chord: it turns by twice the angle between
/// them.
Arc arc_over(const Eigen::Vector2d& tangent, const Eigen::Vector2d& chord) {
  const double across = tangent.x() * chord.y() - tangent.y() * chord.x();
  const double half_turn = slam::arc_tangent(across, tangent.dot(chord));
  const double sine = slam::sine_cosine(half_turn).sine;
  const double sinc = std::abs(half_turn) < 1e-4 ? 1.0 - half_turn * half_turn / 6.0 : sine / half_turn;
  return {chord.norm() / sinc, 2.0 * half_turn};
}

/// The length d of both end tangents: |v|^2 - 2 d v.(t0 + t1) - 2 d^2 (1 - t0.t1) = 0, by the root's stable
/// form.
double tangent_length(const Eigen::Vector2d& v, const Eigen::Vector2d& t0, const Eigen::Vector2d& t1) {
  const double linear = v.dot(t0 + t1);
  const double quadratic = 2.0 * (1.0 - t0.dot(t1));
  return v.squaredNorm() / (linear + std::sqrt(linear * linear + quadratic * v.squaredNorm()));
}

}  // namespace

double heading_of(const Eigen::Vector2d& direction) {
  return slam::arc_tangent(direction.y(), direction.x());
}

std::optional<std::array<Arc, 2>> biarc(const slam::Pose& from, const slam::Pose& to) {
  const Eigen::Vector2d v(to.x_m - from.x_m, to.y_m - from.y_m);
  const Eigen::Vector2d heading = along(from.heading_rad);
  const double direction = heading.dot(v) < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector2d t0 = direction * heading;
  const Eigen::Vector2d t1 = direction * along(to.heading_rad);
  const double d = tangent_length(v, t0, t1);
  if (!std::isfinite(d)) return std::nullopt;
  const Eigen::Vector2d first_chord = 0.5 * (v + d * (t0 - t1));
  const Arc first = arc_over(t0, first_chord);
  const Arc mirrored = arc_over(-t1, first_chord - v);  // from the other end, backwards
  return std::array<Arc, 2>{Arc{direction * first.length_m, first.turn_rad},
                            Arc{direction * mirrored.length_m, -mirrored.turn_rad}};
}

}  // namespace stereobench::worlds
