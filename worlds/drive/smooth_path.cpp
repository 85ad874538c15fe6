#include "worlds/drive/smooth_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "worlds/drive/biarc.h"

namespace stereobench::worlds {
namespace {

using slam::Control;
using slam::Pose;

/// The headings at a curve's points. An open curve's ends head so that one arc leads to their neighbours.
std::vector<double> headings_of(const SplinePath& path) {
  const std::vector<Eigen::Vector2d>& points = path.points_m;
  const std::size_t n = points.size();
  std::vector<double> headings(n);
  for (std::size_t i = 0; i < n; ++i) headings[i] = heading_of(points[(i + 1) % n] - points[(i + n - 1) % n]);
  if (path.closed) return headings;
  const double first_chord = heading_of(points[1] - points[0]);
  const double last_chord = heading_of(points[n - 1] - points[n - 2]);
  if (n == 2) return {first_chord, last_chord};
  headings[0] = slam::wrap_angle(2.0 * first_chord - headings[1]);
  headings[n - 1] = slam::wrap_angle(2.0 * last_chord - headings[n - 2]);
  return headings;
}

/// The controls over an arc in a time.
Control over(const Arc& arc, double duration_s) {
  return {arc.length_m / duration_s, arc.turn_rad / duration_s, duration_s};
}

/// Turns towards a place, drives there, and turns to the heading that is asked for.
std::vector<Control> sideways(double towards_rad, double way_m, double turn_rad, double duration_s) {
  const double part_s = duration_s / 3.0;
  const double first_rad = slam::wrap_angle(towards_rad);
  return {{0.0, first_rad / part_s, part_s},
          {way_m / part_s, 0.0, part_s},
          {0.0, (turn_rad - first_rad) / part_s, part_s}};
}

/// The controls from one pose to another; times are shared out by length.
std::vector<Control> between(const TimedPose& from, const TimedPose& to) {
  const double duration_s = to.time_s - from.time_s;
  const double turn_rad = slam::wrap_angle(to.pose.heading_rad - from.pose.heading_rad);
  const Eigen::Vector2d way(to.pose.x_m - from.pose.x_m, to.pose.y_m - from.pose.y_m);
  if (way.isZero(0.0)) return {{0.0, turn_rad / duration_s, duration_s}};
  const auto arcs = biarc(from.pose, to.pose);
  if (!arcs) return sideways(heading_of(way) - from.pose.heading_rad, way.norm(), turn_rad, duration_s);
  const double total_m = arcs->at(0).length_m + arcs->at(1).length_m;
  std::vector<Control> controls;
  for (const Arc& arc : *arcs) {
    if (arc.length_m != 0.0) controls.push_back(over(arc, duration_s * arc.length_m / total_m));
  }
  return controls;
}

}  // namespace

GroundTruth drive_figure_eight(const CirclePath& path) {
  drive_circle(path);  // refuses what is no size
  const double turn_radps = path.speed_mps / path.radius_m;
  const double circle_s = 2.0 * slam::kPi / turn_radps;
  std::vector<Control> pieces;
  for (double left = 2.0 * path.laps; left > 0.0; left -= 1.0) {
    const double side = pieces.size() % 2 == 0 ? 1.0 : -1.0;
    pieces.push_back({path.speed_mps, side * turn_radps, std::min(left, 1.0) * circle_s});
  }
  return drive_controls(path.start, std::move(pieces), path.step_s, path.odometry_s);
}

GroundTruth drive_spline(const SplinePath& path) {
  const std::size_t n = path.points_m.size();
  if (n < (path.closed ? 3U : 2U))
    throw std::invalid_argument(fmt::format("expected at least {} points_m", path.closed ? 3 : 2));
  if (!(path.speed_mps > 0.0)) throw std::invalid_argument("expected a positive speed_mps");
  const std::vector<double> headings = headings_of(path);
  const auto pose_at = [&](std::size_t i) {
    return Pose{path.points_m[i % n].x(), path.points_m[i % n].y(), headings[i % n]};
  };
  std::vector<Control> pieces;
  for (std::size_t i = 0; i < (path.closed ? n : n - 1); ++i) {
    const auto arcs = biarc(pose_at(i), pose_at(i + 1));
    if (!arcs || !(arcs->at(0).length_m + arcs->at(1).length_m > 0.0)) {
      throw std::invalid_argument(
          fmt::format("expected a curve that does not turn back (points_m[{}] does)", i));
    }
    for (const Arc& arc : *arcs) {
      if (arc.length_m > 0.0) pieces.push_back(over(arc, arc.length_m / path.speed_mps));
    }
  }
  return drive_controls(pose_at(0), std::move(pieces), path.step_s, path.odometry_s);
}

GroundTruth drive_recorded(const std::vector<TimedPose>& poses, double step_s, double odometry_s) {
  if (poses.size() < 2) throw std::invalid_argument("expected a trajectory of two poses at least");
  std::vector<Control> pieces;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!(poses[i].time_s > poses[i - 1].time_s)) {
      throw std::invalid_argument(fmt::format("expected times that ascend ({:.9g} s after {:.9g} s)",
                                              poses[i].time_s, poses[i - 1].time_s));
    }
    for (const Control& control : between(poses[i - 1], poses[i])) pieces.push_back(control);
  }
  return drive_controls(poses.front().pose, std::move(pieces), step_s, odometry_s);
}

}  // namespace stereobench::worlds
