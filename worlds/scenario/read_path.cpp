#include <stdexcept>

#include "slam/math/angles.h"
#include "worlds/drive/smooth_path.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kStep_s = {1e-3, 1e3};

enum class PathKind { kCircle, kPolyline, kTour, kSpline, kFigureEight, kRecorded };

/// What a path's lines say.
struct PathLines {
  PathKind kind = PathKind::kCircle;
  Eigen::Vector2d start_m = Eigen::Vector2d::Zero();
  CirclePath circle;  ///< or one of a figure eight's two
  std::vector<Eigen::Vector2d> points_m;
  bool closed = false;
  std::optional<double> corner_radius_m;
  double overlap_m = 0.0;
  double speed_mps = 1.0;
  double step_s = 1.0;
  double odometry_s = 0.0;
  std::filesystem::path file;
};

CirclePath circle_of(const PathLines& lines) {
  CirclePath path = lines.circle;
  path.start.x_m = lines.start_m.x();
  path.start.y_m = lines.start_m.y();
  path.speed_mps = lines.speed_mps;
  path.step_s = lines.step_s;
  path.odometry_s = lines.odometry_s;
  return path;
}

PolylinePath polyline_of(const PathLines& lines) {
  return {.points_m = lines.points_m,
          .closed = lines.closed,
          .corner_radius_m = lines.corner_radius_m.value(),
          .overlap_m = lines.overlap_m,
          .speed_mps = lines.speed_mps,
          .step_s = lines.step_s,
          .odometry_s = lines.odometry_s};
}

/// The tour of a generated world.
PolylinePath tour_of(PathLines lines, const Layout& layout) {
  lines.points_m = layout.tour_m;
  lines.closed = layout.closed;
  if (!lines.corner_radius_m) lines.corner_radius_m = layout.corner_radius_m;
  return polyline_of(lines);
}

GroundTruth drive(const PathLines& lines, const Layout* layout) {
  switch (lines.kind) {
    case PathKind::kCircle:
      return drive_circle(circle_of(lines));
    case PathKind::kPolyline:
      return drive_polyline(polyline_of(lines));
    case PathKind::kTour:
      return drive_polyline(tour_of(lines, *layout));
    case PathKind::kSpline:
      return drive_spline({.points_m = lines.points_m,
                           .closed = lines.closed,
                           .speed_mps = lines.speed_mps,
                           .step_s = lines.step_s,
                           .odometry_s = lines.odometry_s});
    case PathKind::kFigureEight:
      return drive_figure_eight(circle_of(lines));
    case PathKind::kRecorded:
      break;
  }
  return drive_recorded(read_trajectory(lines.file), lines.step_s, lines.odometry_s);
}

std::vector<Field<PathLines>> shape_and_circle_fields() {
  return {
      choice("kind", {"circle", "polyline", "tour", "spline", "figure_eight", "recorded"},
             "The shape of the drive; `tour` leads through a generated world.")
          .needed()
          .fills(&PathLines::kind),
      number("start_m", kPlace_m, "Where the drive begins: x, y in metres.")
          .only_for({"circle", "figure_eight"})
          .fills(&PathLines::start_m),
      number("start_heading_deg", {-179.999999, 180.0},
             "Heading at the start, in degrees from east to north.")
          .only_for({"circle", "figure_eight"})
          .times(slam::kRadPerDegree)
          .fills(&PathLines::circle, &CirclePath::start, &slam::Pose::heading_rad),
      number("radius_m", kSize_m, "Radius of the circle, or of each of the figure's two, in metres.")
          .only_for({"circle", "figure_eight"})
          .needed_for({"circle", "figure_eight"})
          .fills(&PathLines::circle, &CirclePath::radius_m),
      number("laps", {1e-3, 1e3}, "Times around; need not be whole.")
          .only_for({"circle", "figure_eight"})
          .fills(&PathLines::circle, &CirclePath::laps),
  };
}

/// Of ways through corners or points.
std::vector<Field<PathLines>> way_fields() {
  return {
      number("points_m", kPlace_m,
             "Corners of a polyline, or points that a spline runs through: x, y in metres.")
          .list(2, 1000, 2)
          .only_for({"polyline", "spline"})
          .needed_for({"polyline", "spline"})
          .fills(&PathLines::points_m),
      flag("closed", "Whether the drive ends where it began.")
          .only_for({"polyline", "spline"})
          .fills(&PathLines::closed),
      number("corner_radius_m", kSize_m, "Radius of the arc that rounds each corner, in metres.")
          .only_for({"polyline", "tour"})
          .needed_for({"polyline"})
          .otherwise_says("of a tour: what keeps its distance from the walls")
          .fills(&PathLines::corner_radius_m),
      number("overlap_m", {0.0, 1e4}, "How far a closed drive goes on after the lap, in metres.")
          .only_for({"polyline", "tour"})
          .fills(&PathLines::overlap_m),
  };
}

std::vector<Field<PathLines>> speed_and_file_fields() {
  return {
      number("speed_mps", {1e-3, 100.0}, "Speed of the drive, in metres per second.")
          .only_for({"circle", "polyline", "tour", "spline", "figure_eight"})
          .needed_for({"circle", "polyline", "tour", "spline", "figure_eight"})
          .fills(&PathLines::speed_mps),
      number("step_s", kStep_s, "Time between two frames, in seconds.").needed().fills(&PathLines::step_s),
      number("odometry_s", kStep_s, "Time between two readings of the odometry, in seconds.")
          .otherwise_says("step_s")
          .fills(&PathLines::odometry_s),
      text("file",
           "Trajectory in TUM's format, or a groundtruth.csv of ours; relative to the scenario's folder.")
          .only_for({"recorded"})
          .needed_for({"recorded"})
          .by<PathLines>(
              [](const YamlValue& file, PathLines& lines) { lines.file = file.folder() / file.text(); }),
  };
}

const Fields<PathLines>& path_line_keys() {
  static const Fields<PathLines> keys(
      "kind", joined<PathLines>({shape_and_circle_fields(), way_fields(), speed_and_file_fields()}));
  return keys;
}

}  // namespace

const KeyGroup& path_keys() {
  return path_line_keys();
}

GroundTruth read_path(const YamlValue& value, const Layout* layout) {
  const PathLines lines = path_line_keys().read(value);
  if (lines.kind == PathKind::kTour && (layout == nullptr || layout->tour_m.empty()))
    YamlMap(value, path_keys()).at("kind").refuse("expected a world whose generator makes corridors to tour");
  try {
    return drive(lines, layout);
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

}  // namespace stereobench::worlds
