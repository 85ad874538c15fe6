#include "worlds/scenario/write_scenario.h"

#include <span>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "slam/math/angles.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

/// A number as the fewest digits that are read back as it.
std::string digits(double number) {
  return fmt::format("{}", number);
}

template <typename Vector>
YAML::Node list_of(const Vector& vector) {
  YAML::Node list;
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(digits(vector[i]));
  list.SetStyle(YAML::EmitterStyle::Flow);
  return list;
}

std::string name_of(Material material) {
  return std::string(kMaterialNames[static_cast<std::size_t>(material)]);
}

bool is_tinted(const Eigen::Vector3d& tint_rgb) {
  return tint_rgb != Eigen::Vector3d::Ones();
}

YAML::Node lines_of(const SurfaceTexture& texture) {
  YAML::Node node;
  node["file"] = texture.file;
  node["tile_m"] = digits(texture.tile_m);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

/// @param is_made whether its radius is what it is, and not to be drawn
YAML::Node lines_of(const Ball& ball, bool is_made) {
  YAML::Node node;
  node["colour"] = ball.colour;
  node["at_m"] = list_of(ball.centre_m);
  if (is_made) node["radius_m"] = digits(ball.radius_m);
  if (ball.paint_rgb) node["paint_rgb"] = list_of(*ball.paint_rgb);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

YAML::Node lines_of(const Wall& wall) {
  YAML::Node node;
  node["corners_m"].push_back(list_of(wall.from_m));
  node["corners_m"].push_back(list_of(wall.to_m));
  node["height_m"] = digits(wall.height_m);
  if (wall.material == Material::kFile)
    node["texture"] = lines_of(wall.texture);
  else
    node["material"] = name_of(wall.material);
  if (is_tinted(wall.tint_rgb)) node["tint_rgb"] = list_of(wall.tint_rgb);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

/// A shape that stands upright, as things that are scattered do.
YAML::Node lines_of(const MeshInstance& mesh) {
  YAML::Node node;
  node["shape"] = std::string(kShapeNames[static_cast<std::size_t>(mesh.shape) - 1]);
  node["at_m"] = list_of(mesh.position_m);
  node["heading_deg"] = digits(mesh.heading_rad / slam::kRadPerDegree);
  node["scale"] = list_of(mesh.scale);
  node["material"] = name_of(mesh.material);
  node["tint_rgb"] = list_of(mesh.tint_rgb);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

template <typename Things>
YAML::Node list_of_lines(const Things& things) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const auto& thing : things) list.push_back(lines_of(thing));
  return list;
}

YAML::Node list_of_balls(const World& world) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const Ball& ball : world.balls)
    list.push_back(lines_of(ball, !ball.has_usual_radius || world.ball_radius_sd_m == 0.0));
  return list;
}

void write_tour(const Layout& layout, YAML::Node path) {
  path["kind"] = "polyline";
  YAML::Node points;
  for (const Eigen::Vector2d& point : layout.tour_m) points.push_back(list_of(point));
  path["points_m"] = points;
  path["closed"] = layout.closed;
  if (!path["corner_radius_m"]) path["corner_radius_m"] = digits(layout.corner_radius_m);
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
  if (!world.walls.empty()) lines["walls"] = list_of_lines(world.walls);
  lines["balls"] = list_of_balls(world);
}

/// Says what a seed has made of the world. @param meshes how many of its meshes have lines already
void write_drawn(const Randomisation& randomise, const World& world, std::size_t meshes, YAML::Node lines) {
  lines["balls"] = list_of_balls(world);
  if (randomise.walls && !world.walls.empty()) lines["walls"] = list_of_lines(world.walls);
  if (randomise.floor) {
    lines.remove("floor");
    lines.remove("floor_texture");
    if (world.floor == Material::kFile)
      lines["floor_texture"] = lines_of(world.floor_texture);
    else
      lines["floor"] = name_of(world.floor);
    lines["floor_tint_rgb"] = list_of(world.floor_tint_rgb);
  }
  if (randomise.light) {
    lines["light"]["towards_light"] = list_of(world.light.towards_light);
    lines["light"]["ambient"] = digits(world.light.ambient);
    lines["light"]["diffuse"] = digits(world.light.diffuse);
  }
  for (std::size_t i = meshes; i < world.meshes.size(); ++i)
    lines["meshes"].push_back(lines_of(world.meshes[i]));
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
