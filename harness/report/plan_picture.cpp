#include "harness/report/plan_picture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "vision/palette.h"
#include "worlds/path.h"
#include "worlds/sight.h"

namespace stereobench::harness {
namespace {

constexpr double kSide_px = 900.0;  // the longer side of the plan
constexpr double kMargin_px = 30.0;
constexpr double kText_px = 62.0;  // below it
constexpr std::size_t kSectors = 12;

/// How the drive is drawn where so many balls are in view; the last stands for more.
constexpr std::array<const char*, 4> kCoverage = {"#d62728", "#ff9f1c", "#8fbf5a", "#1b7f3b"};

const char* coverage_colour(int balls) {
  return kCoverage[static_cast<std::size_t>(std::clamp(balls, 0, static_cast<int>(kCoverage.size()) - 1))];
}

/// The sheet: from metres to pixels, and what has been drawn.
class Sheet {
 public:
  explicit Sheet(const Eigen::AlignedBox2d& extent_m)
      : extent_(extent_m), scale_(kSide_px / std::max(extent_m.sizes().maxCoeff(), 1e-3)) {}

  double to_px(double length_m) const { return scale_ * length_m; }
  std::string point(const Eigen::Vector2d& at_m) const {
    return fmt::format("{:.1f},{:.1f}", x(at_m), y(at_m));
  }
  void line(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, std::string_view style) {
    body_ += fmt::format("<path d=\"M{} L{}\" {}/>\n", point(from_m), point(to_m), style);
  }
  void disc(const Eigen::Vector2d& at_m, double radius_px, std::string_view style) {
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", x(at_m), y(at_m),
                         radius_px, style);
  }
  void polygon(std::span<const Eigen::Vector2d> corners_m, std::string_view style) {
    std::vector<std::string> points;
    for (const Eigen::Vector2d& corner : corners_m) points.push_back(point(corner));
    body_ += fmt::format("<polygon points=\"{}\" {}/>\n", fmt::join(points, " "), style);
  }
  /// Text below the plan, in lines.
  void text(double x_px, int row, std::string_view words, std::string_view style = "") {
    body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x_px,
                         bottom_px() + 18.0 * (row + 1), style, words);
  }
  double bottom_px() const { return scale_ * extent_.sizes().y() + 2.0 * kMargin_px; }
  std::string document() const {
    const double width_px = std::max(scale_ * extent_.sizes().x() + 2.0 * kMargin_px, 640.0);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
        width_px, bottom_px() + kText_px, body_);
  }

 private:
  double x(const Eigen::Vector2d& at_m) const { return kMargin_px + scale_ * (at_m.x() - extent_.min().x()); }
  double y(const Eigen::Vector2d& at_m) const { return kMargin_px + scale_ * (extent_.max().y() - at_m.y()); }

  Eigen::AlignedBox2d extent_;
  double scale_;
  std::string body_;
};

Eigen::Vector2d place_of(const worlds::PathStep& step) {
  return {step.pose.x_m, step.pose.y_m};
}

Eigen::AlignedBox2d extent_of(const worlds::World& world, const worlds::GroundTruth& path,
                              std::span<const FloorLine> outlines) {
  Eigen::AlignedBox2d box;
  for (const worlds::Wall& wall : world.walls) box.extend(wall.from_m).extend(wall.to_m);
  for (const FloorLine& line : outlines) box.extend(line.from_m).extend(line.to_m);
  for (const worlds::Ball& ball : world.balls) box.extend(Eigen::Vector2d(ball.centre_m.head<2>()));
  for (const worlds::PathStep& step : path) box.extend(place_of(step));
  return box;
}

/// A length of 1, 2 or 5 times a power of ten, about a tenth of the plan.
double bar_m(const Sheet& sheet) {
  double length_m = 1e-3;
  for (const double factor :
       {2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5})
    if (sheet.to_px(length_m) < 60.0) length_m *= factor;
  return length_m;
}

void draw_scale(Sheet& sheet, const Eigen::AlignedBox2d& extent) {
  const double length_m = bar_m(sheet);
  const Eigen::Vector2d foot = extent.min() - Eigen::Vector2d(0.0, 20.0 / sheet.to_px(1.0));
  sheet.line(foot, foot + Eigen::Vector2d(length_m, 0.0), "stroke=\"black\" stroke-width=\"2\"");
  sheet.text(kMargin_px, 0, fmt::format("{:g} m", length_m));
}

/// How far, and how wide, the robot looks.
struct Sector {
  double reach_m = 0.0;
  double half_angle_rad = 0.0;
};

Sector sector_of(const worlds::Scenario& scenario) {
  if (scenario.sensor == worlds::SensorKind::kOracle)
    return {scenario.oracle.max_range_m, scenario.oracle.field_of_view_rad / 2.0};
  const vision::Intrinsics& camera = scenario.rig.camera;
  const double radius_m = scenario.world.balls.front().radius_m;  // stereo: one for all
  return {camera.focal_px * radius_m / worlds::kLeastRadius_px,
          std::atan(0.5 * camera.width_px / camera.focal_px)};
}

/// How far one sees from a point along a direction: to the nearest line that hides what is behind it.
double sight_m(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double reach_m,
               std::span<const FloorLine> lines) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  for (const FloorLine& line : lines) {
    const Eigen::Vector2d along = line.to_m - line.from_m;
    const double turn = cross(direction, along);
    if (!line.hides || turn == 0.0) continue;
    const double distance_m = cross(line.from_m - from, along) / turn;
    const double share = cross(line.from_m - from, direction) / turn;
    if (distance_m > 0.0 && share >= 0.0 && share <= 1.0) reach_m = std::min(reach_m, distance_m);
  }
  return reach_m;
}

void draw_sectors(Sheet& sheet, const worlds::Scenario& scenario, std::span<const FloorLine> lines) {
  const Sector sector = sector_of(scenario);
  const std::size_t steps = scenario.path.size();
  const std::size_t count = std::min(kSectors, steps);
  for (std::size_t i = 0; i < count; ++i) {
    const worlds::PathStep& step = scenario.path[i * steps / count];
    std::vector<Eigen::Vector2d> corners = {place_of(step)};
    for (int k = -60; k <= 60; ++k) {
      const double angle_rad = step.pose.heading_rad + sector.half_angle_rad * k / 60.0;
      const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
      corners.push_back(corners.front() +
                        sight_m(corners.front(), direction, sector.reach_m, lines) * direction);
    }
    sheet.polygon(corners, "fill=\"#4a90d9\" fill-opacity=\"0.1\" stroke=\"#4a90d9\" stroke-opacity=\"0.3\"");
  }
}

/// What a plan's lines of sight end at.
std::vector<FloorLine> hiding_lines(const worlds::World& world, double eye_height_m,
                                    std::span<const FloorLine> outlines) {
  std::vector<FloorLine> lines(outlines.begin(), outlines.end());
  for (const worlds::Wall& wall : world.walls)
    lines.push_back({wall.from_m, wall.to_m, wall.height_m > eye_height_m});
  return lines;
}

void draw_drive(Sheet& sheet, const worlds::GroundTruth& path, const ViewCoverage& coverage) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    sheet.line(place_of(path[i - 1]), place_of(path[i]),
               fmt::format("stroke=\"{}\" stroke-width=\"3\" stroke-linecap=\"round\"",
                           coverage_colour(coverage.balls_in_view[i])));
  }
  const slam::Pose& start = path.front().pose;
  const Eigen::Vector2d ahead(std::cos(start.heading_rad), std::sin(start.heading_rad));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double size_m = 12.0 / sheet.to_px(1.0);
  const Eigen::Vector2d at = place_of(path.front());
  sheet.polygon(std::array<Eigen::Vector2d, 3>{at + 1.4 * size_m * ahead, at + 0.6 * size_m * left,
                                               at - 0.6 * size_m * left},
                "fill=\"black\"");
}

void draw_balls(Sheet& sheet, const worlds::World& world, const ViewCoverage& coverage) {
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const worlds::Ball& ball = world.balls[i];
    const auto [r, g, b] = vision::kPalette[static_cast<std::size_t>(ball.colour)];
    const Eigen::Vector2d at = ball.centre_m.head<2>();
    const double radius_px = std::max(5.0, sheet.to_px(ball.radius_m));
    sheet.disc(at, radius_px,
               fmt::format("fill=\"rgb({},{},{})\" stroke=\"black\" stroke-width=\"0.7\"", r, g, b));
    if (coverage.steps_seen[i] > 0) continue;
    const Eigen::Vector2d arm = Eigen::Vector2d(radius_px, radius_px) / sheet.to_px(1.0);
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d way(arm.x(), side * arm.y());
      sheet.line(at - way, at + way, "stroke=\"black\" stroke-width=\"1.5\"");
    }
  }
}

void write_legend(Sheet& sheet, const worlds::Scenario& scenario, const ViewCoverage& coverage) {
  const auto unseen = std::ranges::count(coverage.steps_seen, 0);
  sheet.text(kMargin_px, 2,
             fmt::format("{}: {} balls ({} never in view), {:.1f} m in {} steps", scenario.name,
                         scenario.world.balls.size(), unseen, worlds::length_m(scenario.path),
                         scenario.path.size()));
  sheet.text(200.0, 0, "balls in view:");
  for (int balls = 0; balls < static_cast<int>(kCoverage.size()); ++balls) {
    const bool last = balls + 1 == static_cast<int>(kCoverage.size());
    sheet.text(310.0 + 70.0 * balls, 0, fmt::format("&#9632; {}{}", balls, last ? " or more" : ""),
               fmt::format("fill=\"{}\"", coverage_colour(balls)));
  }
}

}  // namespace

ViewCoverage view_coverage(const worlds::Scenario& scenario, const worlds::World& world) {
  ViewCoverage coverage;
  coverage.steps_seen.resize(world.balls.size());
  for (const worlds::PathStep& step : scenario.path) {
    const std::vector<int> seen = worlds::balls_in_view(scenario, world, step.pose);
    coverage.balls_in_view.push_back(static_cast<int>(seen.size()));
    for (const int ball : seen) ++coverage.steps_seen[static_cast<std::size_t>(ball)];
  }
  return coverage;
}

std::vector<FloorLine> mesh_outlines(const worlds::World& world, double eye_height_m,
                                     const renderer::FormReader& read) {
  const renderer::MeshSurfaces placed = renderer::place_meshes(world, read);
  const auto corner = [&](int i) {
    return Eigen::Vector3f(placed.vertices[static_cast<std::size_t>(i)].position).cast<double>().eval();
  };
  std::vector<FloorLine> lines;
  for (const renderer::MeshRun& run : placed.runs) {
    double top_m = 0.0;
    for (int i = run.first; i < run.first + run.count; ++i) top_m = std::max(top_m, corner(i).z());
    const double level_m = std::min(eye_height_m, 0.5 * top_m);
    for (int i = run.first; i < run.first + run.count; i += 3) {
      std::vector<Eigen::Vector2d> ends;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = corner(i + k);
        const Eigen::Vector3d b = corner(i + (k + 1) % 3);
        if ((a.z() > level_m) == (b.z() > level_m)) continue;
        ends.push_back((a + (level_m - a.z()) / (b.z() - a.z()) * (b - a)).head<2>());
      }
      if (ends.size() == 2) lines.push_back({ends[0], ends[1], level_m == eye_height_m});
    }
  }
  return lines;
}

std::string draw_plan(const worlds::Scenario& scenario, const worlds::World& world,
                      const ViewCoverage& coverage, std::span<const FloorLine> outlines) {
  const Eigen::AlignedBox2d extent = extent_of(world, scenario.path, outlines);
  Sheet sheet(extent);
  draw_sectors(sheet, scenario, hiding_lines(world, scenario.rig.height_m, outlines));
  for (const FloorLine& line : outlines)
    sheet.line(line.from_m, line.to_m, "stroke=\"#a0795a\" stroke-width=\"1\"");
  for (const worlds::Wall& wall : world.walls)
    sheet.line(wall.from_m, wall.to_m, "stroke=\"#444\" stroke-width=\"2\" stroke-linecap=\"square\"");
  draw_drive(sheet, scenario.path, coverage);
  draw_balls(sheet, world, coverage);
  draw_scale(sheet, extent);
  write_legend(sheet, scenario, coverage);
  return sheet.document();
}

}  // namespace stereobench::harness
