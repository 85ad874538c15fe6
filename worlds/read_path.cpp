#include <array>
#include <numbers>
#include <stdexcept>

#include "worlds/scenario_parts.h"
#include "worlds/smooth_path.h"

namespace stereobench::worlds {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {1e-3, 1e4};
constexpr Interval kSpeed_mps = {1e-3, 100.0};
constexpr Interval kStep_s = {1e-3, 1e3};

/// What a circle and a figure eight are both said by.
CirclePath read_circles(const YamlValue& value) {
  const YamlMap map(value, {"kind", "start_m", "start_heading_deg", "radius_m", "speed_mps", "laps", "step_s",
                            "odometry_s"});
  CirclePath path;
  if (const auto start = map.find("start_m")) {
    const Eigen::Vector2d start_m = read_vector<2>(*start, kPlace_m);
    path.start = {start_m.x(), start_m.y(), 0.0};
  }
  path.start.heading_rad = map.number("start_heading_deg", {-179.999999, 180.0}, 0.0) * kDegree;
  path.radius_m = map.number("radius_m", kSize_m);
  path.speed_mps = map.number("speed_mps", kSpeed_mps);
  path.laps = map.number("laps", {1e-3, 1e3}, 1.0);
  path.step_s = map.number("step_s", kStep_s);
  path.odometry_s = map.number("odometry_s", kStep_s, 0.0);
  return path;
}

GroundTruth read_polyline(const YamlValue& value) {
  const YamlMap map(value, {"kind", "points_m", "closed", "corner_radius_m", "overlap_m", "speed_mps",
                            "step_s", "odometry_s"});
  PolylinePath path;
  for (const YamlValue& point : map.at("points_m").list(2, 1000)) {
    path.points_m.push_back(read_vector<2>(point, kPlace_m));
  }
  if (const auto closed = map.find("closed")) path.closed = closed->flag();
  path.corner_radius_m = map.number("corner_radius_m", kSize_m);
  path.overlap_m = map.number("overlap_m", {0.0, 1e4}, 0.0);
  path.speed_mps = map.number("speed_mps", kSpeed_mps);
  path.step_s = map.number("step_s", kStep_s);
  path.odometry_s = map.number("odometry_s", kStep_s, 0.0);
  return drive_polyline(path);
}

/// The tour of a generated world.
GroundTruth read_tour(const YamlValue& value, const Layout* layout) {
  const YamlMap map(value, {"kind", "corner_radius_m", "overlap_m", "speed_mps", "step_s", "odometry_s"});
  if (layout == nullptr || layout->tour_m.empty())
    map.at("kind").refuse("expected a world whose generator makes corridors to tour");
  PolylinePath path;
  path.points_m = layout->tour_m;
  path.closed = layout->closed;
  path.corner_radius_m = map.number("corner_radius_m", kSize_m, layout->corner_radius_m);
  path.overlap_m = map.number("overlap_m", {0.0, 1e4}, 0.0);
  path.speed_mps = map.number("speed_mps", kSpeed_mps);
  path.step_s = map.number("step_s", kStep_s);
  path.odometry_s = map.number("odometry_s", kStep_s, 0.0);
  return drive_polyline(path);
}

GroundTruth read_spline(const YamlValue& value) {
  const YamlMap map(value, {"kind", "points_m", "closed", "speed_mps", "step_s", "odometry_s"});
  SplinePath path;
  for (const YamlValue& point : map.at("points_m").list(2, 1000))
    path.points_m.push_back(read_vector<2>(point, kPlace_m));
  if (const auto closed = map.find("closed")) path.closed = closed->flag();
  path.speed_mps = map.number("speed_mps", kSpeed_mps);
  path.step_s = map.number("step_s", kStep_s);
  path.odometry_s = map.number("odometry_s", kStep_s, 0.0);
  return drive_spline(path);
}

GroundTruth read_recorded(const YamlValue& value, const std::filesystem::path& folder) {
  const YamlMap map(value, {"kind", "file", "step_s", "odometry_s"});
  const std::vector<TimedPose> poses = read_trajectory(folder / map.at("file").text());
  return drive_recorded(poses, map.number("step_s", kStep_s), map.number("odometry_s", kStep_s, 0.0));
}

}  // namespace

GroundTruth read_path(const YamlValue& value, const Layout* layout, const std::filesystem::path& folder) {
  const YamlMap map(value, {"kind", "start_m", "start_heading_deg", "radius_m", "laps", "points_m", "closed",
                            "corner_radius_m", "overlap_m", "speed_mps", "step_s", "odometry_s", "file"});
  constexpr std::array<std::string_view, 6> kKinds = {"circle", "polyline",     "tour",
                                                      "spline", "figure_eight", "recorded"};
  const std::size_t kind = map.at("kind").choice(kKinds);
  try {
    switch (kind) {
      case 0:
        return drive_circle(read_circles(value));
      case 1:
        return read_polyline(value);
      case 2:
        return read_tour(value, layout);
      case 3:
        return read_spline(value);
      case 4:
        return drive_figure_eight(read_circles(value));
      default:
        return read_recorded(value, folder);
    }
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

}  // namespace stereobench::worlds
