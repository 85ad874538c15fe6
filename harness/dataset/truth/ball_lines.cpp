#include "harness/dataset/truth/ball_lines.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "renderer/surfaces/primitives.h"
#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

Json box_json(const cv::Rect& box) {
  if (box.empty()) return {-1, -1, -1, -1};
  return {box.x, box.y, box.width, box.height};
}

Json line(const worlds::World& world, const renderer::BallTruth& truth) {
  const Eigen::Vector3d& centre = truth.centre_in_camera_m;
  const vision::OutlineEllipse& outline = truth.outline;
  return {{"ball_id", truth.ball},
          {"colour", world.balls[static_cast<std::size_t>(truth.ball)].colour},
          {"centre_in_camera_m", {centre.x(), centre.y(), centre.z()}},
          {"centre_px", {truth.centre_px.x(), truth.centre_px.y()}},
          {"outline",
           {{"centre_px", {outline.centre_px.x(), outline.centre_px.y()}},
            {"semi_axes_px", {outline.semi_major_px, outline.semi_minor_px}},
            {"angle_rad", outline.angle_rad}}},
          {"px_count_all", truth.px_count_all},
          {"px_count_visib", truth.px_count_visib},
          {"visib_fract", truth.visib_fract},
          {"bbox_obj", box_json(truth.bbox_obj)},
          {"bbox_visib", box_json(truth.bbox_visib)},
          {"truncated", truth.truncated}};
}

}  // namespace

std::string ball_lines(const worlds::World& world, std::span<const renderer::BallTruth> truths) {
  std::string lines;
  for (const renderer::BallTruth& truth : truths) lines += line(world, truth).dump() + "\n";
  return lines;
}

std::string balls_csv(const worlds::World& world) {
  std::string csv = "ball_id,colour,red,green,blue,x_m,y_m,z_m,radius_m\n";
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const worlds::Ball& ball = world.balls[i];
    const Eigen::Vector3d rgb = 255.0 * worlds::paint_of(ball);
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", i, ball.colour, rgb.x(), rgb.y(), rgb.z(),
                       ball.centre_m.x(), ball.centre_m.y(), ball.centre_m.z(), ball.radius_m);
  }
  return csv;
}

std::string surfaces_csv(const worlds::World& world) {
  std::string csv = "surface_id,kind,index\n";
  const auto add = [&](int first, const char* kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      csv += fmt::format("{},{},{}\n", first + static_cast<int>(i), kind, i);
  };
  add(1, "ball", world.balls.size());
  add(renderer::kFloorPrimitive, "floor", world.has_floor ? 1 : 0);
  add(renderer::kFirstWallPrimitive, "wall", world.walls.size());
  add(renderer::first_mesh_primitive(world), "mesh", world.meshes.size());
  return csv;
}

}  // namespace stereobench::harness
