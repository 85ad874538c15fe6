#include "worlds/scenario/write_scenario.h"

#include <yaml-cpp/yaml.h>

#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

YAML::Node lines_of(const Wall& wall) {
  return wall_keys().write({.corners_m = {wall.from_m, wall.to_m}, .wall = wall});
}

YAML::Node list_of_walls(const World& world) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const Wall& wall : world.walls) list.push_back(lines_of(wall));
  return list;
}

/// The radius of a ball is said unless it is to be drawn.
YAML::Node list_of_balls(const World& world) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (Ball ball : world.balls) {
    ball.has_usual_radius = ball.has_usual_radius && world.ball_radius_sd_m != 0.0;
    list.push_back(ball_keys().write(ball));
  }
  return list;
}

void write_tour(const Layout& layout, YAML::Node path) {
  path["kind"] = "polyline";
  YAML::Node points;
  for (const Eigen::Vector2d& point : layout.tour_m) points.push_back(written(Key{}, point));
  path["points_m"] = points;
  path["closed"] = layout.closed;
  if (!path["corner_radius_m"]) path["corner_radius_m"] = written(Key{}, layout.corner_radius_m);
}

/// The generator that a scenario's text names, made again.
Layout layout_of(const YamlDocument& document) {
  const YamlMap map(YamlValue(document, "world", document.root["world"], {}), world_keys());
  return read_generator(map.at("generator"), read_ball_radius_m(map)).layout;
}

/// Says a generator's world line by line.
void write_generated(const YamlDocument& document, const World& world, YAML::Node lines) {
  YAML::Node path = document.root["path"];
  if (path["kind"].as<std::string>() == "tour") write_tour(layout_of(document), path);
  lines.remove("generator");
  if (!world.walls.empty()) lines["walls"] = list_of_walls(world);
  lines["balls"] = list_of_balls(world);
}

/// Says what a seed has made of the world. @param meshes how many of its meshes have lines already
void write_drawn(const Randomisation& randomise, const World& world, std::size_t meshes, YAML::Node lines) {
  lines["balls"] = list_of_balls(world);
  if (randomise.walls && !world.walls.empty()) lines["walls"] = list_of_walls(world);
  if (randomise.floor) {
    lines.remove("floor");
    lines.remove("floor_texture");
    world_keys().write_into(lines, world, {"floor", "floor_texture", "floor_tint_rgb"});
  }
  if (randomise.light) light_keys().write_into(lines["light"], world.light);
  for (std::size_t i = meshes; i < world.meshes.size(); ++i)
    lines["meshes"].push_back(mesh_keys().write(world.meshes[i]));
}

std::string from_anywhere(const YamlDocument& document, const YAML::Node& path) {
  return std::filesystem::absolute(document.file.parent_path() / path.as<std::string>())
      .lexically_normal()
      .string();
}

/// What is written may lie in another folder than what was read.
void name_files_from_anywhere(const YamlDocument& document) {
  const YAML::Node root = document.root;
  name_file_from_anywhere(document, root["path"]);
  YAML::Node world = root["world"];
  name_file_from_anywhere(document, world["floor_texture"]);
  for (YAML::Node wall : world["walls"]) name_file_from_anywhere(document, wall["texture"]);
  for (YAML::Node searched : world["texture_folders"]) searched = from_anywhere(document, searched);
  for (const char* surface : {"walls", "floor"}) {
    if (!root["randomise"] || !root["randomise"][surface]) continue;
    for (YAML::Node texture : root["randomise"][surface]["textures"])
      name_file_from_anywhere(document, texture);
  }
}

}  // namespace

void name_file_from_anywhere(const YamlDocument& document, YAML::Node group) {
  if (group && group.IsMap() && group["file"]) group["file"] = from_anywhere(document, group["file"]);
}

void write_world(const Scenario& scenario, std::optional<std::uint64_t> seed, YamlDocument& document) {
  YAML::Node lines = document.root["world"];
  name_files_from_anywhere(document);
  const std::vector<MeshInstance>& meshes = scenario.world.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (meshes[i].shape == MeshShape::kFile) lines["meshes"][i]["file"] = meshes[i].file;
  if (lines["generator"]) write_generated(document, scenario.world, lines);
  if (!seed) return;
  write_drawn(scenario.randomise, world_for_seed(scenario, *seed), meshes.size(), lines);
  document.root.remove("randomise");
  document.root["placement_jitter_m"] = 0;
}

}  // namespace stereobench::worlds
