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

void name_file_from_anywhere(const std::filesystem::path& folder, YAML::Node named) {
  if (named && named.IsMap() && named["file"])
    named["file"] =
        std::filesystem::absolute(folder / named["file"].as<std::string>()).lexically_normal().string();
}

/// What is written may lie in another folder than what was read.
void name_files_from_anywhere(const std::filesystem::path& folder, YAML::Node root) {
  for (const char* group : {"path", "believed_measurement_noise"})
    name_file_from_anywhere(folder, root[group]);
  YAML::Node world = root["world"];
  name_file_from_anywhere(folder, world["floor_texture"]);
  for (YAML::Node wall : world["walls"]) name_file_from_anywhere(folder, wall["texture"]);
  for (YAML::Node searched : world["texture_folders"])
    searched = std::filesystem::absolute(folder / searched.as<std::string>()).lexically_normal().string();
  for (const char* surface : {"walls", "floor"}) {
    if (!root["randomise"] || !root["randomise"][surface]) continue;
    for (YAML::Node texture : root["randomise"][surface]["textures"])
      name_file_from_anywhere(folder, texture);
  }
}

std::string text_of(const YAML::Node& root) {
  YAML::Emitter text;
  text << root;
  return std::string(text.c_str()) + "\n";
}

void gather_files(const YAML::Node& node, std::set<std::string>& files) {
  for (const auto& entry : node) {
    const YAML::Node& value = node.IsMap() ? entry.second : entry;
    if (node.IsMap() && value.IsScalar() && entry.first.Scalar() == "file") files.insert(value.Scalar());
    if (value.IsMap() || value.IsSequence()) gather_files(value, files);
  }
}

}  // namespace

std::string with_overrides(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return text_of(load_yaml(file, overrides).root);
}

std::set<std::string> files_named_in(const std::filesystem::path& file,
                                     const std::vector<std::string>& overrides) {
  std::set<std::string> files;
  gather_files(load_yaml(file, overrides).root, files);
  return files;
}

std::string written_out(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        std::optional<std::uint64_t> seed, const OccluderReader& occluders) {
  const Scenario scenario = read_scenario(file, overrides, occluders);
  YamlDocument document = load_yaml(file, overrides, &scenario_keys());
  YAML::Node lines = document.root["world"];
  name_files_from_anywhere(file.parent_path(), document.root);
  const std::vector<MeshInstance>& meshes = scenario.world.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (meshes[i].shape == MeshShape::kFile) lines["meshes"][i]["file"] = meshes[i].file;
  if (lines["generator"]) write_generated(document, scenario.world, lines);
  if (seed) {
    write_drawn(scenario.randomise, world_for_seed(scenario, *seed), meshes.size(), lines);
    document.root.remove("randomise");
    document.root["placement_jitter_m"] = 0;
    document.root["seeds"] = *seed;
  }
  return text_of(document.root);
}

}  // namespace stereobench::worlds
