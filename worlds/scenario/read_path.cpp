#include <stdexcept>

#include "slam/math/angles.h"
#include "worlds/drive/smooth_path.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {1e-3, 1e4};
constexpr Interval kStep_s = {1e-3, 1e3};

enum class Kind { kCircle, kPolyline, kTour, kSpline, kFigureEight, kRecorded };

/// What a circle and a figure eight are both said by.
CirclePath read_circles(const YamlMap& map) {
  CirclePath path;
  const Eigen::Vector2d start_m = read_vector<2>(map, "start_m", Eigen::Vector2d(0.0, 0.0));
  path.start = {start_m.x(), start_m.y(), map.number("start_heading_deg", 0.0) * slam::kRadPerDegree};
  path.radius_m = map.number("radius_m");
  path.speed_mps = map.number("speed_mps");
  path.laps = map.number("laps", path.laps);
  path.step_s = map.number("step_s");
  path.odometry_s = map.number("odometry_s", path.odometry_s);
  return path;
}

std::vector<Eigen::Vector2d> read_points(const YamlMap& map) {
  std::vector<Eigen::Vector2d> points_m;
  for (const YamlValue& point : map.at("points_m").list(2, 1000))
    points_m.push_back(read_vector<2>(point, kPlace_m));
  return points_m;
}

/// The rest of a polyline, once it is known where it leads.
GroundTruth drive_along(const YamlMap& map, PolylinePath path) {
  path.overlap_m = map.number("overlap_m", path.overlap_m);
  path.speed_mps = map.number("speed_mps");
  path.step_s = map.number("step_s");
  path.odometry_s = map.number("odometry_s", path.odometry_s);
  return drive_polyline(path);
}

GroundTruth read_polyline(const YamlMap& map) {
  PolylinePath path;
  path.points_m = read_points(map);
  path.closed = map.flag("closed", path.closed);
  path.corner_radius_m = map.number("corner_radius_m");
  return drive_along(map, path);
}

/// The tour of a generated world.
GroundTruth read_tour(const YamlMap& map, const Layout* layout) {
  if (layout == nullptr || layout->tour_m.empty())
    map.at("kind").refuse("expected a world whose generator makes corridors to tour");
  PolylinePath path;
  path.points_m = layout->tour_m;
  path.closed = layout->closed;
  path.corner_radius_m = map.number("corner_radius_m", layout->corner_radius_m);
  return drive_along(map, path);
}

GroundTruth read_spline(const YamlMap& map) {
  SplinePath path;
  path.points_m = read_points(map);
  path.closed = map.flag("closed", path.closed);
  path.speed_mps = map.number("speed_mps");
  path.step_s = map.number("step_s");
  path.odometry_s = map.number("odometry_s", path.odometry_s);
  return drive_spline(path);
}

GroundTruth read_recorded(const YamlMap& map, const std::filesystem::path& folder) {
  const double step_s = map.number("step_s");
  const double odometry_s = map.number("odometry_s", 0.0);
  return drive_recorded(read_trajectory(folder / map.at("file").text()), step_s, odometry_s);
}

GroundTruth drive(Kind kind, const YamlMap& map, const Layout* layout, const std::filesystem::path& folder) {
  switch (kind) {
    case Kind::kCircle:
      return drive_circle(read_circles(map));
    case Kind::kPolyline:
      return read_polyline(map);
    case Kind::kTour:
      return read_tour(map, layout);
    case Kind::kSpline:
      return read_spline(map);
    case Kind::kFigureEight:
      return drive_figure_eight(read_circles(map));
    case Kind::kRecorded:
      break;
  }
  return read_recorded(map, folder);
}

}  // namespace

const KeyGroup& path_keys() {
  static const KeyGroup keys = {
      .kind_key = "kind",
      .keys = {
          choice("kind", {"circle", "polyline", "tour", "spline", "figure_eight", "recorded"},
                 "The shape of the drive; `tour` leads through a generated world.")
              .needed(),
          number("start_m", kPlace_m, "Where the drive begins: x, y in metres.")
              .vector(2)
              .only_for({"circle", "figure_eight"})
              .otherwise("[0, 0]"),
          number("start_heading_deg", {-179.999999, 180.0},
                 "Heading at the start, in degrees from east to north.")
              .only_for({"circle", "figure_eight"})
              .otherwise("0"),
          number("radius_m", kSize_m, "Radius of the circle, or of each of the figure's two, in metres.")
              .only_for({"circle", "figure_eight"})
              .needed_for({"circle", "figure_eight"}),
          number("laps", {1e-3, 1e3}, "Times around; need not be whole.")
              .only_for({"circle", "figure_eight"})
              .otherwise("1"),
          number("points_m", kPlace_m,
                 "Corners of a polyline, or points that a spline runs through: x, y in metres.")
              .list(2, 1000, 2)
              .only_for({"polyline", "spline"})
              .needed_for({"polyline", "spline"}),
          flag("closed", "Whether the drive ends where it began.")
              .only_for({"polyline", "spline"})
              .otherwise("false"),
          number("corner_radius_m", kSize_m, "Radius of the arc that rounds each corner, in metres.")
              .only_for({"polyline", "tour"})
              .needed_for({"polyline"})
              .otherwise_says("of a tour: what keeps its distance from the walls"),
          number("overlap_m", {0.0, 1e4}, "How far a closed drive goes on after the lap, in metres.")
              .only_for({"polyline", "tour"})
              .otherwise("0"),
          number("speed_mps", {1e-3, 100.0}, "Speed of the drive, in metres per second.")
              .only_for({"circle", "polyline", "tour", "spline", "figure_eight"})
              .needed_for({"circle", "polyline", "tour", "spline", "figure_eight"}),
          number("step_s", kStep_s, "Time between two frames, in seconds.").needed(),
          number("odometry_s", kStep_s, "Time between two readings of the odometry, in seconds.")
              .otherwise_says("step_s"),
          text("file",
               "Trajectory in TUM's format, or a groundtruth.csv of ours; relative to the scenario's folder.")
              .only_for({"recorded"})
              .needed_for({"recorded"}),
      }};
  return keys;
}

GroundTruth read_path(const YamlValue& value, const Layout* layout, const std::filesystem::path& folder) {
  const YamlMap map(value, path_keys());
  try {
    return drive(static_cast<Kind>(map.choice("kind")), map, layout, folder);
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

}  // namespace stereobench::worlds
