#include "harness/report/plan_picture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "harness/report/plan_sheet.h"
#include "vision/palette.h"
#include "worlds/drive/path.h"
#include "worlds/visibility/visibility.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kSectors = 12;

/// How the drive is drawn where so many balls are in view; the last stands for more.
constexpr std::array<const char*, 4> kCoverage = {"#d62728", "#ff9f1c", "#8fbf5a", "#1b7f3b"};

const char* coverage_colour(int balls) {
  return kCoverage[static_cast<std::size_t>(std::clamp(balls, 0, static_cast<int>(kCoverage.size()) - 1))];
}

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
  const double edge_m =
      0.03 * std::max(box.sizes().maxCoeff(), 1e-3);  // what stands at the edge is seen whole
  return {box.min() - Eigen::Vector2d(edge_m, edge_m), box.max() + Eigen::Vector2d(edge_m, edge_m)};
}

worlds::ViewSector sector_of(const worlds::Scenario& scenario) {
  if (scenario.sensor == worlds::SensorKind::kOracle)
    return {scenario.oracle.max_range_m, 0.5 * scenario.oracle.field_of_view_rad};
  return worlds::view_sector(scenario.rig, scenario.world.ball_radius_m());
}

/// How far one sees from a point along a direction: to the nearest line that hides what is behind it.
double free_m(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double reach_m,
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

void draw_sectors(PlanSheet& sheet, const worlds::Scenario& scenario, std::span<const FloorLine> lines) {
  const worlds::ViewSector sector = sector_of(scenario);
  const std::size_t steps = scenario.path.size();
  const std::size_t count = std::min(kSectors, steps);
  for (std::size_t i = 0; i < count; ++i) {
    const worlds::PathStep& step = scenario.path[i * steps / count];
    std::vector<Eigen::Vector2d> corners = {place_of(step)};
    for (int k = -60; k <= 60; ++k) {
      const double angle_rad = step.pose.heading_rad + sector.half_angle_rad * k / 60.0;
      const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
      corners.push_back(corners.front() +
                        free_m(corners.front(), direction, sector.range_m, lines) * direction);
    }
    sheet.polygon(corners, "fill=\"#4a90d9\" fill-opacity=\"0.1\" stroke=\"#4a90d9\" stroke-opacity=\"0.3\"");
  }
}

/// What a plan's lines of sight end at.
std::vector<FloorLine> hiding_lines(const worlds::World& world, double camera_height_m,
                                    std::span<const FloorLine> outlines) {
  std::vector<FloorLine> lines(outlines.begin(), outlines.end());
  for (const worlds::Wall& wall : world.walls)
    lines.push_back({wall.from_m, wall.to_m, wall.height_m > camera_height_m});
  return lines;
}

void draw_drive(PlanSheet& sheet, const worlds::GroundTruth& path, const ViewCoverage& coverage) {
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

void draw_balls(PlanSheet& sheet, const worlds::World& world, const ViewCoverage& coverage) {
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const worlds::Ball& ball = world.balls[i];
    const auto [r, g, b] = vision::kPalette[static_cast<std::size_t>(ball.colour)];
    const Eigen::Vector2d at = ball.centre_m.head<2>();
    const double radius_px = std::max(5.0, sheet.to_px(ball.radius_m));
    sheet.disc(at, radius_px,
               fmt::format("fill=\"rgb({},{},{})\" stroke=\"black\" stroke-width=\"0.7\"", r, g, b));
    sheet.label(at, {radius_px + 2.0, -radius_px}, fmt::format("{}", i), "fill=\"#333\" font-size=\"10\"");
    if (coverage.steps_seen[i] > 0) continue;
    const Eigen::Vector2d arm = Eigen::Vector2d(radius_px, radius_px) / sheet.to_px(1.0);
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d way(arm.x(), side * arm.y());
      sheet.line(at - way, at + way, "stroke=\"black\" stroke-width=\"1.5\"");
    }
  }
}

/// A cross where the drive goes through something.
void draw_crossings(PlanSheet& sheet, std::span<const worlds::Crossing> crossings) {
  const double arm_m = 9.0 / sheet.to_px(1.0);
  for (const worlds::Crossing& crossing : crossings)
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d way(arm_m, side * arm_m);
      sheet.line(crossing.at_m - way, crossing.at_m + way, "stroke=\"#d6006e\" stroke-width=\"3\"");
    }
}

void write_legend(PlanSheet& sheet, const worlds::Scenario& scenario, const ViewCoverage& coverage) {
  const auto unseen = std::ranges::count(coverage.steps_seen, 0);
  sheet.text(0.0, 1,
             fmt::format("{}: {} balls ({} never in view{}), {:.1f} m in {} steps", scenario.name,
                         scenario.world.balls.size(), unseen, unseen > 0 ? ", crossed out" : "",
                         worlds::length_m(scenario.path), scenario.path.size()));
  sheet.text(0.0, 0, "balls in view on the drive:");
  for (int balls = 0; balls < static_cast<int>(kCoverage.size()); ++balls) {
    const bool last = balls + 1 == static_cast<int>(kCoverage.size());
    sheet.text(190.0 + 70.0 * balls, 0, fmt::format("&#9632; {}{}", balls, last ? " or more" : ""),
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

std::vector<FloorLine> mesh_outlines(const worlds::World& world, double camera_height_m,
                                     const renderer::FormReader& read) {
  const renderer::MeshSurfaces placed = renderer::place_meshes(world, read);
  const auto corner = [&](int i) {
    return Eigen::Vector3f(placed.vertices[static_cast<std::size_t>(i)].position).cast<double>().eval();
  };
  std::vector<FloorLine> lines;
  for (const renderer::MeshRun& run : placed.runs) {
    double top_m = 0.0;
    for (int i = run.first; i < run.first + run.count; ++i) top_m = std::max(top_m, corner(i).z());
    const double level_m = std::min(camera_height_m, 0.5 * top_m);
    for (int i = run.first; i < run.first + run.count; i += 3) {
      std::vector<Eigen::Vector2d> ends;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = corner(i + k);
        const Eigen::Vector3d b = corner(i + (k + 1) % 3);
        if ((a.z() > level_m) == (b.z() > level_m)) continue;
        ends.push_back((a + (level_m - a.z()) / (b.z() - a.z()) * (b - a)).head<2>());
      }
      if (ends.size() == 2) lines.push_back({ends[0], ends[1], level_m == camera_height_m});
    }
  }
  return lines;
}

std::vector<worlds::Crossing> drive_crossings(const worlds::World& world, const worlds::GroundTruth& path,
                                              std::span<const FloorLine> outlines) {
  std::vector<worlds::FloorSegment> lines = worlds::feet_of(world.walls);
  for (const FloorLine& line : outlines)
    if (line.hides) lines.push_back({line.from_m, line.to_m});
  return worlds::crossings(path, lines);
}

std::vector<int> never_in_view(const ViewCoverage& coverage) {
  std::vector<int> balls;
  for (std::size_t i = 0; i < coverage.steps_seen.size(); ++i)
    if (coverage.steps_seen[i] == 0) balls.push_back(static_cast<int>(i));
  return balls;
}

std::string draw_plan(const worlds::Scenario& scenario, const worlds::World& world,
                      const ViewCoverage& coverage, std::span<const FloorLine> outlines) {
  PlanSheet sheet(extent_of(world, scenario.path, outlines));
  sheet.axes();
  draw_sectors(sheet, scenario, hiding_lines(world, scenario.rig.height_m, outlines));
  for (const FloorLine& line : outlines)
    sheet.line(line.from_m, line.to_m, "stroke=\"#a0795a\" stroke-width=\"1\"");
  for (const worlds::Wall& wall : world.walls)
    sheet.line(wall.from_m, wall.to_m, "stroke=\"#444\" stroke-width=\"2\" stroke-linecap=\"square\"");
  draw_drive(sheet, scenario.path, coverage);
  draw_balls(sheet, world, coverage);
  draw_crossings(sheet, drive_crossings(world, scenario.path, outlines));
  write_legend(sheet, scenario, coverage);
  return sheet.document();
}

}  // namespace stereobench::harness
