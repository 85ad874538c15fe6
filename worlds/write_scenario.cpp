#include "worlds/write_scenario.h"

#include <span>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "worlds/generator.h"
#include "worlds/scenario.h"
#include "worlds/scenario_parts.h"

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

YAML::Node lines_of(const Ball& ball) {
  YAML::Node node;
  node["colour"] = ball.colour;
  node["at_m"] = list_of(ball.centre_m);
  node["radius_m"] = digits(ball.radius_m);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

YAML::Node lines_of(const Wall& wall) {
  YAML::Node node;
  node["corners_m"].push_back(list_of(wall.from_m));
  node["corners_m"].push_back(list_of(wall.to_m));
  node["height_m"] = digits(wall.height_m);
  node["material"] = std::string(kMaterialNames[static_cast<std::size_t>(wall.material)]);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

template <typename Things>
YAML::Node list_of_lines(const Things& things) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const auto& thing : things) list.push_back(lines_of(thing));
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
  const YamlMap map(YamlValue(document, "world", document.root["world"], {}), kWorldKeys);
  return read_generator(map.at("generator"), read_ball_radius_m(map)).layout;
}

}  // namespace

std::string written_out(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const World world = read_scenario(file, overrides).world;
  YamlDocument document = load_yaml(file, overrides);
  YAML::Node lines = document.root["world"];
  for (const char* group : {"path", "believed_measurement_noise"}) {
    YAML::Node named = document.root[group];
    if (named && named["file"])
      named["file"] =
          std::filesystem::absolute(file.parent_path() / named["file"].as<std::string>()).string();
  }
  for (std::size_t i = 0; i < world.meshes.size(); ++i) lines["meshes"][i]["file"] = world.meshes[i].file;
  if (lines["generator"]) {
    YAML::Node path = document.root["path"];
    if (path["kind"].as<std::string>() == "tour") write_tour(layout_of(document), path);
    lines.remove("generator");
    if (!world.walls.empty()) lines["walls"] = list_of_lines(world.walls);
    lines["balls"] = list_of_lines(world.balls);
  }
  YAML::Emitter text;
  text << document.root;
  return std::string(text.c_str()) + "\n";
}

}  // namespace stereobench::worlds
