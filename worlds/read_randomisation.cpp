#include <array>
#include <span>

#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kShare = {0.0, 1.0};
constexpr Interval kShade = {0.0, 2.0};
constexpr Interval kTintOffset = {-1.0, 1.0};
constexpr Interval kSize_m = {1e-3, 10.0};
constexpr Interval kAway_m = {0.0, 100.0};
constexpr Interval kTurn_deg = {-360.0, 360.0};
constexpr Interval kUp_deg = {-90.0, 90.0};

/// [least, most], or one number for both; what is there already where the key is left out.
void read_range(const YamlMap& map, std::string_view key, const Interval& within, Range& range) {
  const auto value = map.find(key);
  if (!value) return;
  if (!value->is_list()) {
    range.least = range.most = value->number(within);
    return;
  }
  const Eigen::Vector2d bounds = read_vector<2>(*value, within);
  if (bounds[0] > bounds[1]) value->refuse("expected the least first: [least, most]");
  range = {bounds[0], bounds[1]};
}

void read_count(const YamlMap& map, Range& range) {
  constexpr int kMost = 1000;
  read_range(map, "count", {0.0, kMost}, range);
  if (const auto value = map.find("count")) {
    if (!value->is_list())
      value->integer(0, kMost);
    else
      for (const YamlValue& bound : value->list(2, 2)) bound.integer(0, kMost);
  }
}

/// A list of names, as what their places in the list of all of them mean.
template <typename Kind>
void read_kinds(const YamlMap& map, std::string_view key, std::span<const std::string_view> names, int first,
                std::vector<Kind>& kinds) {
  const auto value = map.find(key);
  if (!value) return;
  kinds.clear();
  for (const YamlValue& entry : value->list(1, 100))
    kinds.push_back(static_cast<Kind>(first + static_cast<int>(entry.choice(names))));
}

void read_looks(const YamlMap& map, SurfaceLooks& looks) {
  read_kinds(map, "materials", std::span(kMaterialNames).first(6), 0, looks.materials);
  read_range(map, "shade", kShade, looks.shade);
  read_range(map, "tint", kTintOffset, looks.tint);
}

/// Where textures are named and materials are not, there are textures alone.
SurfaceLooks read_surface(const YamlValue& value, const std::filesystem::path& folder) {
  const YamlMap map(value, {"materials", "textures", "shade", "tint"});
  SurfaceLooks looks;
  if (const auto textures = map.find("textures")) {
    looks.materials.clear();
    for (const YamlValue& texture : textures->list(1, 100))
      looks.textures.push_back(read_surface_texture(texture, folder));
  }
  read_looks(map, looks);
  return looks;
}

BallColours read_ball_colours(const YamlValue& value) {
  const YamlMap map(value, {"shuffle", "shade", "tint"});
  BallColours colours;
  if (const auto shuffle = map.find("shuffle")) colours.shuffle = shuffle->flag();
  read_range(map, "shade", kShade, colours.shade);
  read_range(map, "tint", kTintOffset, colours.tint);
  return colours;
}

LightRanges read_light_ranges(const YamlValue& value) {
  const YamlMap map(value, {"azimuth_deg", "elevation_deg", "ambient", "diffuse"});
  LightRanges light;
  read_range(map, "azimuth_deg", kTurn_deg, light.azimuth_deg);
  read_range(map, "elevation_deg", kUp_deg, light.elevation_deg);
  read_range(map, "ambient", kShare, light.ambient);
  read_range(map, "diffuse", kShare, light.diffuse);
  return light;
}

void read_strewn(const YamlMap& map, Strewn& strewn) {
  read_count(map, strewn.count);
  read_range(map, "size_m", kSize_m, strewn.size_m);
  read_range(map, "range_m", kAway_m, strewn.range_m);
  read_range(map, "bearing_deg", kTurn_deg, strewn.bearing_deg);
  strewn.clearance_m = map.number("clearance_m", kAway_m, strewn.clearance_m);
}

Clutter read_clutter(const YamlValue& value) {
  const YamlMap map(
      value, {"count", "size_m", "range_m", "bearing_deg", "clearance_m", "materials", "shade", "tint"});
  Clutter clutter;
  read_strewn(map, clutter.strewn);
  read_looks(map, clutter.looks);
  return clutter;
}

Distractors read_distractors(const YamlValue& value) {
  const YamlMap map(value,
                    {"count", "size_m", "range_m", "bearing_deg", "clearance_m", "shapes", "shade", "tint"});
  Distractors distractors;
  read_strewn(map, distractors.strewn);
  read_kinds(map, "shapes", kShapeNames, 1, distractors.shapes);
  read_range(map, "shade", kShade, distractors.shade);
  read_range(map, "tint", kTintOffset, distractors.tint);
  return distractors;
}

}  // namespace

Randomisation read_randomisation(const YamlValue& value, int balls_in_view,
                                 const std::filesystem::path& folder) {
  const YamlMap map(value,
                    {"ball_colours", "walls", "floor", "light", "clutter", "distractors", "balls_in_view"});
  Randomisation randomise{.balls_in_view = balls_in_view};
  if (const auto colours = map.find("ball_colours")) randomise.ball_colours = read_ball_colours(*colours);
  if (const auto walls = map.find("walls")) randomise.walls = read_surface(*walls, folder);
  if (const auto floor = map.find("floor")) randomise.floor = read_surface(*floor, folder);
  if (const auto light = map.find("light")) randomise.light = read_light_ranges(*light);
  if (const auto clutter = map.find("clutter")) randomise.clutter = read_clutter(*clutter);
  if (const auto things = map.find("distractors")) randomise.distractors = read_distractors(*things);
  if (const auto least = map.find("balls_in_view")) randomise.balls_in_view = least->integer(0, 254);
  return randomise;
}

}  // namespace stereobench::worlds
