#include "harness/dataset/truth/ball_lines.h"

#include <limits>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/dataset/truth/bop_numbers.h"
#include "harness/json/json_line.h"
#include "renderer/surfaces/primitives.h"
#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

Json line(const worlds::World& world, const renderer::BallTruth& truth) {
  const Eigen::Vector3d& centre = truth.centre_in_camera_m;
  const vision::OutlineEllipse& outline = truth.outline;
  Json json = {{"ball_id", truth.ball},
               {"colour", world.balls[static_cast<std::size_t>(truth.ball)].colour},
               {"centre_in_camera_m", {centre.x(), centre.y(), centre.z()}},
               {"centre_px", {truth.centre_px.x(), truth.centre_px.y()}},
               {"outline",
                {{"centre_px", {outline.centre_px.x(), outline.centre_px.y()}},
                 {"semi_axes_px", {outline.semi_major_px, outline.semi_minor_px}},
                 {"angle_rad", outline.angle_rad}}}};
  json.update(bop_numbers(truth));
  json["truncated"] = truth.truncated;
  return json;
}

constexpr double kMost = std::numeric_limits<double>::max();

cv::Rect box_from(const JsonValue& json) {
  constexpr std::int64_t kFarthest_px = std::numeric_limits<int>::max();
  const auto sides = json.list(4, 4);
  const auto side = [&](std::size_t i) {
    return static_cast<int>(sides[i].integer(-kFarthest_px, kFarthest_px));
  };
  const cv::Rect box(side(0), side(1), side(2), side(3));
  return box.empty() ? cv::Rect() : box;
}

Eigen::Vector2d two_numbers(const JsonValue& json) {
  const auto numbers = json.list(2, 2);
  return {numbers[0].number(-kMost, kMost), numbers[1].number(-kMost, kMost)};
}

vision::OutlineEllipse outline_from(const JsonValue& json) {
  const Eigen::Vector2d semi_axes_px = two_numbers(json.at("semi_axes_px"));
  return {two_numbers(json.at("centre_px")), semi_axes_px.x(), semi_axes_px.y(),
          json.at("angle_rad").number(-kMost, kMost)};
}

renderer::BallTruth truth_from(const JsonValue& json, std::size_t balls) {
  constexpr std::int64_t kMostPixels = std::numeric_limits<long>::max();
  renderer::BallTruth truth;
  truth.ball = static_cast<int>(json.at("ball_id").integer(0, static_cast<std::int64_t>(balls) - 1));
  const auto centre = json.at("centre_in_camera_m").list(3, 3);
  for (int i = 0; i < 3; ++i)
    truth.centre_in_camera_m[i] = centre[static_cast<std::size_t>(i)].number(-kMost, kMost);
  truth.centre_px = two_numbers(json.at("centre_px"));
  truth.outline = outline_from(json.at("outline"));
  truth.px_count_all = json.at("px_count_all").integer(0, kMostPixels);
  truth.px_count_visib = json.at("px_count_visib").integer(0, kMostPixels);
  truth.visib_fract = json.at("visib_fract").number(0.0, kMost);
  truth.bbox_obj = box_from(json.at("bbox_obj"));
  truth.bbox_visib = box_from(json.at("bbox_visib"));
  truth.truncated = json.at("truncated").flag();
  return truth;
}

}  // namespace

std::string ball_lines(const worlds::World& world, std::span<const renderer::BallTruth> truths) {
  std::string lines;
  for (const renderer::BallTruth& truth : truths) lines += line(world, truth).dump() + "\n";
  return lines;
}

std::vector<renderer::BallTruth> parse_ball_lines(const std::string& text, std::size_t balls,
                                                  const std::string& name) {
  std::vector<renderer::BallTruth> truths;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) try {
      const nlohmann::json json = parse_line(line);
      truths.push_back(truth_from(JsonValue(json, ""), balls));
    } catch (const BadLine& bad) {
      throw std::runtime_error(fmt::format("{}:{}: {}", name, truths.size() + 1, bad.what()));
    }
  return truths;
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
