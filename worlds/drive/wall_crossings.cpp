#include "worlds/drive/wall_crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/models/motion.h"

namespace stereobench::worlds {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d place_of(const slam::Pose& pose) {
  return {pose.x_m, pose.y_m};
}

/// The places that the robot comes through on its way to a step, with where it came from.
std::vector<Eigen::Vector2d> way_to(const PathStep& step, const slam::Pose& from) {
  constexpr double kChord_rad = 0.0873;  // 5 degrees: a chord of a 1 m arc is 1 mm off
  std::vector<Eigen::Vector2d> way = {place_of(from)};
  slam::Pose pose = from;
  for (const slam::Control& control : step.controls) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil(std::abs(control.w_radps * control.duration_s) / kChord_rad)));
    slam::Control part = control;
    part.duration_s = control.duration_s / parts;
    for (int i = 0; i < parts; ++i) {
      pose = slam::advance(pose, part);
      way.push_back(place_of(pose));
    }
  }
  way.push_back(place_of(step.pose));  // exactly
  return way;
}

/// Where two lines meet; nowhere for parallel ones.
std::optional<Eigen::Vector2d> meeting(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                       const FloorSegment& line) {
  const Eigen::Vector2d way = to - from;
  const Eigen::Vector2d along = line.to_m - line.from_m;
  const double area = cross(way, along);
  if (area == 0.0) return std::nullopt;
  const double on_way = cross(line.from_m - from, along) / area;
  const double on_line = cross(line.from_m - from, way) / area;
  if (!(on_way >= 0.0 && on_way <= 1.0 && on_line >= 0.0 && on_line <= 1.0)) return std::nullopt;
  return from + on_way * way;
}

std::optional<Eigen::Vector2d> meeting(const std::vector<Eigen::Vector2d>& way, const FloorSegment& line) {
  for (std::size_t i = 1; i < way.size(); ++i)
    if (const auto at_m = meeting(way[i - 1], way[i], line)) return at_m;
  return std::nullopt;
}

}  // namespace

std::vector<FloorSegment> feet_of(const std::vector<Wall>& walls) {
  std::vector<FloorSegment> feet;
  for (const Wall& wall : walls) feet.push_back({wall.from_m, wall.to_m});
  return feet;
}

std::vector<Crossing> crossings(const GroundTruth& path, std::span<const FloorSegment> lines) {
  std::vector<Crossing> found;
  for (std::size_t step = 1; step < path.size(); ++step) {
    const std::vector<Eigen::Vector2d> way = way_to(path[step], path[step - 1].pose);
    for (const FloorSegment& line : lines)
      if (const auto at_m = meeting(way, line)) found.push_back({step, *at_m});
  }
  return found;
}

}  // namespace stereobench::worlds
