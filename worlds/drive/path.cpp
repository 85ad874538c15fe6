#include "worlds/drive/path.h"

#include <algorithm>
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

constexpr double kSliver_s = 1e-9;  ///< pieces of time shorter than the stamps resolve are not driven
constexpr double kMostSteps = 100000.0;
constexpr double kMostReadings = 1000000.0;

void require_positive(double value, const char* what) {
  if (!std::isfinite(value) || value <= 0.0) {
    throw std::invalid_argument(fmt::format("expected a positive {} (got {:g})", what, value));
  }
}

double duration_s(const std::vector<Control>& pieces) {
  double sum_s = 0.0;
  for (const Control& piece : pieces) sum_s += piece.duration_s;
  return sum_s;
}

/// Takes the controls of the next `wanted_s` off the front of what is still to be driven.
std::vector<Control> take(std::vector<Control>& pieces, std::size_t& next, double wanted_s) {
  std::vector<Control> taken;
  while (wanted_s > kSliver_s && next < pieces.size()) {
    Control& piece = pieces[next];
    // A piece that ends a sliver from the boundary ends on it.
    const bool whole = piece.duration_s <= wanted_s + kSliver_s;
    const double part_s = std::min(piece.duration_s, wanted_s);
    if (part_s > kSliver_s) taken.push_back({piece.v_mps, piece.w_radps, part_s});
    wanted_s -= part_s;
    piece.duration_s -= part_s;
    if (whole) ++next;
  }
  return taken;
}

/// Cuts the controls of a step where the odometry is read within it.
std::vector<Control> cut_at_readings(std::vector<Control> controls, double odometry_s) {
  if (odometry_s == 0.0) return controls;
  std::vector<Control> cut;
  for (std::size_t next = 0; next < controls.size();) {
    const std::vector<Control> reading = take(controls, next, odometry_s);
    cut.insert(cut.end(), reading.begin(), reading.end());
  }
  return cut;
}

/// A polyline's corner: how far from it the arc begins and ends, and by how much it turns.
struct RoundedCorner {
  double tangent_m = 0.0;
  double turn_rad = 0.0;  ///< positive turns left
};

/// The corners of a polyline, indexed like its points; the ends of an open one have none (all zero).
std::vector<RoundedCorner> corners_of(const PolylinePath& path) {
  const std::size_t n = path.points_m.size();
  std::vector<RoundedCorner> corners(n);
  for (std::size_t i = path.closed ? 0 : 1; i + (path.closed ? 0 : 1) < n; ++i) {
    const Eigen::Vector2d in = path.points_m[i] - path.points_m[(i + n - 1) % n];
    const Eigen::Vector2d out = path.points_m[(i + 1) % n] - path.points_m[i];
    const double turn_rad = slam::wrap_angle(heading_of(out) - heading_of(in));
    if (std::abs(turn_rad) > 0.99 * slam::kPi) {
      throw std::invalid_argument(fmt::format("expected no turning back (points_m[{}] does)", i));
    }
    corners[i] = {path.corner_radius_m * slam::tangent(std::abs(turn_rad) / 2.0), turn_rad};
  }
  return corners;
}

/// The straight part of the edge from point i to the next.
double straight_m(const PolylinePath& path, const std::vector<RoundedCorner>& corners, std::size_t i) {
  const std::size_t j = (i + 1) % path.points_m.size();
  const double edge_m = (path.points_m[j] - path.points_m[i]).norm();
  const double left_m = edge_m - corners[i].tangent_m - corners[j].tangent_m;
  if (!(edge_m > 0.0) || left_m < -1e-12) {
    throw std::invalid_argument(
        fmt::format("expected room for the rounded corners between points_m[{}] and points_m[{}] "
                    "({:.3f} m apart, {:.3f} m needed)",
                    i, j, edge_m, corners[i].tangent_m + corners[j].tangent_m));
  }
  return std::max(left_m, 0.0);
}

/// Straights and arcs in turn, from the first edge to the last.
std::vector<Control> pieces_of(const PolylinePath& path, const std::vector<RoundedCorner>& corners) {
  const std::size_t n = path.points_m.size();
  std::vector<Control> pieces;
  for (std::size_t i = 0; i < (path.closed ? n : n - 1); ++i) {
    pieces.push_back({path.speed_mps, 0.0, straight_m(path, corners, i) / path.speed_mps});
    const double turn_rad = corners[(i + 1) % n].turn_rad;
    if (turn_rad == 0.0) continue;
    const double turn_rate_radps = std::copysign(path.speed_mps / path.corner_radius_m, turn_rad);
    pieces.push_back({path.speed_mps, turn_rate_radps, turn_rad / turn_rate_radps});
  }
  return pieces;
}

/// The pieces of a lap, and of the lap after it as far as the overlap reaches.
std::vector<Control> with_overlap(std::vector<Control> lap, double overlap_s) {
  if (overlap_s > duration_s(lap)) throw std::invalid_argument("expected overlap_m of at most a lap");
  std::vector<Control> again = lap;
  std::size_t next = 0;
  for (const Control& piece : take(again, next, overlap_s)) lap.push_back(piece);
  return lap;
}

void require_drivable(const PolylinePath& path) {
  if (path.points_m.size() < (path.closed ? 3U : 2U)) {
    throw std::invalid_argument(fmt::format("expected at least {} points_m", path.closed ? 3 : 2));
  }
  require_positive(path.corner_radius_m, "corner_radius_m");
  require_positive(path.speed_mps, "speed_mps");
  if (!(path.overlap_m >= 0.0) || (path.overlap_m > 0.0 && !path.closed)) {
    throw std::invalid_argument("expected overlap_m of 0 or more, and only on a closed path");
  }
}

}  // namespace

GroundTruth drive_controls(const Pose& start, std::vector<Control> pieces, double step_s, double odometry_s) {
  const double total_s = duration_s(pieces);
  require_positive(step_s, "step_s");
  if (!(total_s / step_s <= kMostSteps)) {
    throw std::invalid_argument(
        fmt::format("expected at most {} steps (got {:.0f})", kMostSteps, total_s / step_s));
  }
  if (odometry_s != 0.0 && !(odometry_s > kSliver_s && total_s / odometry_s <= kMostReadings)) {
    throw std::invalid_argument(fmt::format("expected at most {} readings of the odometry", kMostReadings));
  }
  GroundTruth path = {{0, start, {}}};
  std::size_t next = 0;
  for (std::int64_t k = 1; next < pieces.size(); ++k) {
    PathStep step;
    const double until_s = std::min(static_cast<double>(k) * step_s, total_s);
    step.stamp_ns = std::llround(until_s * 1e9);
    step.controls = cut_at_readings(take(pieces, next, step_s), odometry_s);
    if (step.controls.empty()) break;
    step.pose = path.back().pose;
    for (const Control& control : step.controls) step.pose = slam::advance(step.pose, control);
    path.push_back(step);
  }
  return path;
}

GroundTruth drive_circle(const CirclePath& path) {
  require_positive(path.radius_m, "radius_m");
  require_positive(path.speed_mps, "speed_mps");
  require_positive(path.laps, "laps");
  const double turn_rate_radps = path.speed_mps / path.radius_m;
  const double duration_s = path.laps * 2.0 * slam::kPi / turn_rate_radps;
  return drive_controls(path.start, {{path.speed_mps, turn_rate_radps, duration_s}}, path.step_s,
                        path.odometry_s);
}

GroundTruth drive_polyline(const PolylinePath& path) {
  require_drivable(path);
  const std::vector<RoundedCorner> corners = corners_of(path);
  const Eigen::Vector2d along = (path.points_m[1] - path.points_m[0]).stableNormalized();
  const Eigen::Vector2d start_m = path.points_m[0] + corners[0].tangent_m * along;
  std::vector<Control> pieces = pieces_of(path, corners);
  if (path.overlap_m > 0.0) pieces = with_overlap(std::move(pieces), path.overlap_m / path.speed_mps);
  return drive_controls({start_m.x(), start_m.y(), heading_of(along)}, std::move(pieces), path.step_s,
                        path.odometry_s);
}

slam::Pose pose_near(const GroundTruth& path, std::size_t index, double offset_s) {
  slam::Pose pose = path.at(index).pose;
  double left_s = std::abs(offset_s);
  const auto follow = [&](slam::Control control, double direction) {
    const double used_s = std::min(left_s, control.duration_s);
    control.duration_s = direction * used_s;
    pose = slam::advance(pose, control);
    left_s -= used_s;
  };
  if (offset_s > 0.0) {
    for (std::size_t i = index + 1; i < path.size() && left_s > 0.0; ++i)
      for (const Control& control : path[i].controls) follow(control, 1.0);
  } else {
    for (std::size_t i = index; i > 0 && left_s > 0.0; --i)
      std::for_each(path[i].controls.rbegin(), path[i].controls.rend(),
                    [&](const Control& control) { follow(control, -1.0); });
  }
  return pose;
}

double length_m(const GroundTruth& path) {
  double sum_m = 0.0;
  for (const PathStep& step : path) {
    for (const Control& control : step.controls) sum_m += std::abs(control.v_mps) * control.duration_s;
  }
  return sum_m;
}

}  // namespace stereobench::worlds
