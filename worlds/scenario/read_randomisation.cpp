#include <array>
#include <numeric>

#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kShare = {0.0, 1.0};
constexpr Interval kShade = {0.0, 2.0};
constexpr Interval kTintOffset = {-1.0, 1.0};
constexpr Interval kSize_m = {1e-3, 10.0};
constexpr Interval kAway_m = {0.0, 100.0};
constexpr Interval kTurn_deg = {-360.0, 360.0};
constexpr Interval kUp_deg = {-90.0, 90.0};
constexpr std::size_t kOurMaterials = 6;  // all but a file's

/// A range, [least, most], or one number for both.
Key range(std::string_view name, const Interval& within, std::string_view says) {
  return number(name, within, says).or_vector(2);
}

Key shade(std::string_view fallback) {
  return range("shade", kShade, "Factor on the colour.").otherwise(fallback);
}

Key tint(std::string_view says, std::string_view fallback) {
  return range("tint", kTintOffset, says).otherwise(fallback);
}

Key materials() {
  return choice("materials", {kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials},
                "Materials that one is drawn from.")
      .list(1, 100);
}

/// @return the keys of things beside the drive, and then some
KeyGroup scattered_keys(std::string_view count, std::string_view size_m, std::vector<Key> more) {
  KeyGroup keys = {
      .keys = {
          whole("count", 0, 1000, "How many things there are.").or_vector(2).otherwise(count),
          range("size_m", kSize_m, "Sides of a box, or a ball's diameter, in metres.").otherwise(size_m),
          range("range_m", kAway_m, "Distance from a step of the drive to a thing's middle, in metres.")
              .otherwise("[0.5, 3]"),
          range("bearing_deg", kTurn_deg, "Direction of a thing from that step, in degrees to the left.")
              .otherwise("[-180, 180]"),
          number("clearance_m", kAway_m, "Distance between the drive and a thing, in metres.")
              .otherwise("0.4"),
      }};
  keys.keys.insert(keys.keys.end(), more.begin(), more.end());
  return keys;
}

void read_range(const YamlMap& map, std::string_view key, Range& range) {
  const std::vector<double> bounds = map.numbers(key, {range.least, range.most});
  if (bounds[0] > bounds[1]) map.at(key).refuse("expected the least first: [least, most]");
  range = {bounds[0], bounds[1]};
}

/// A list of names, as what their places among all of them mean. @param first meaning of the first name
template <typename Kind>
void read_kinds(const YamlMap& map, std::string_view key, int first, std::vector<Kind>& kinds) {
  std::vector<std::size_t> places;
  for (const Kind kind : kinds) places.push_back(static_cast<std::size_t>(static_cast<int>(kind) - first));
  kinds.clear();
  for (const std::size_t place : map.choices(key, places))
    kinds.push_back(static_cast<Kind>(first + static_cast<int>(place)));
}

/// Where textures are named and materials are not, there are textures alone.
SurfaceLooks read_surface(const YamlValue& value, const std::filesystem::path& folder) {
  const YamlMap map(value, surface_keys());
  SurfaceLooks looks;
  for (const YamlValue& texture : map.list("textures"))
    looks.textures.push_back(read_surface_texture(texture, folder));
  if (looks.textures.empty() || map.find("materials"))
    read_kinds(map, "materials", 0, looks.materials);
  else
    looks.materials.clear();
  read_range(map, "shade", looks.shade);
  read_range(map, "tint", looks.tint);
  return looks;
}

BallColours read_ball_colours(const YamlValue& value) {
  const YamlMap map(value, ball_colour_keys());
  BallColours colours;
  colours.shuffle = map.flag("shuffle", colours.shuffle);
  read_range(map, "shade", colours.shade);
  read_range(map, "tint", colours.tint);
  return colours;
}

LightRanges read_light_ranges(const YamlValue& value) {
  const YamlMap map(value, light_range_keys());
  LightRanges light;
  read_range(map, "azimuth_deg", light.azimuth_deg);
  read_range(map, "elevation_deg", light.elevation_deg);
  read_range(map, "ambient", light.ambient);
  read_range(map, "diffuse", light.diffuse);
  return light;
}

void read_scattered(const YamlMap& map, Scattered& scattered) {
  read_range(map, "count", scattered.count);
  read_range(map, "size_m", scattered.size_m);
  read_range(map, "range_m", scattered.range_m);
  read_range(map, "bearing_deg", scattered.bearing_deg);
  scattered.clearance_m = map.number("clearance_m", scattered.clearance_m);
}

Clutter read_clutter(const YamlValue& value) {
  const YamlMap map(value, clutter_keys());
  Clutter clutter;
  read_scattered(map, clutter.scattered);
  read_kinds(map, "materials", 0, clutter.looks.materials);
  read_range(map, "shade", clutter.looks.shade);
  read_range(map, "tint", clutter.looks.tint);
  return clutter;
}

Distractors read_distractors(const YamlValue& value) {
  const YamlMap map(value, distractor_keys());
  Distractors distractors;
  read_scattered(map, distractors.scattered);
  read_kinds(map, "shapes", 1, distractors.shapes);
  read_range(map, "shade", distractors.shade);
  read_range(map, "tint", distractors.tint);
  return distractors;
}

}  // namespace

const KeyGroup& surface_keys() {
  static const KeyGroup keys = {
      .keys = {
          materials().otherwise_says("[plain, plaster, bricks, wood, tiles], or none beside textures"),
          group("textures", surface_texture_keys(), "Pictures, each as likely as a material.").list(1, 100),
          shade("[0.7, 1.1]"),
          tint("Part of the colour that each channel is brighter by.", "[-0.1, 0.1]"),
      }};
  return keys;
}

const KeyGroup& ball_colour_keys() {
  static const KeyGroup keys = {
      .keys = {
          flag("shuffle", "Whether the palette's colours change places.").otherwise("true"),
          shade("[0.8, 1]"),
          tint("What is added to each channel, as a part of full light.", "[0, 0.05]"),
      }};
  return keys;
}

const KeyGroup& light_range_keys() {
  static const KeyGroup keys = {
      .keys = {
          range("azimuth_deg", kTurn_deg, "Where light comes from, in degrees from east to north.")
              .otherwise("[-180, 180]"),
          range("elevation_deg", kUp_deg, "How high it stands, in degrees.").otherwise("[20, 80]"),
          range("ambient", kShare, "Light that comes from everywhere.").otherwise("[0.35, 0.55]"),
          range("diffuse", kShare, "Light that falls at a right angle.").otherwise("[0.3, 0.45]"),
      }};
  return keys;
}

const KeyGroup& clutter_keys() {
  static const KeyGroup keys =
      scattered_keys("[3, 8]", "[0.15, 0.5]",
                     {materials().otherwise("[plain, plaster, bricks, wood, tiles]"), shade("[0.7, 1.1]"),
                      tint("Part of the colour that each channel is brighter by.", "[-0.1, 0.1]")});
  return keys;
}

const KeyGroup& distractor_keys() {
  static const KeyGroup keys = scattered_keys(
      "[2, 5]", "[0.05, 0.3]",
      {choice("shapes", {kShapeNames.begin(), kShapeNames.end()}, "Shapes that one is drawn from.")
           .list(1, 100)
           .otherwise("[box, ball]"),
       shade("[0.7, 1]"),
       tint("What is added to each channel of a ball's colour, as a part of full light.", "[-0.1, 0.1]")});
  return keys;
}

const KeyGroup& randomisation_keys() {
  static const KeyGroup keys = {
      .keys = {
          group("ball_colours", ball_colour_keys(), "Paint = shade x the palette's colour + tint."),
          group("walls", surface_keys(), "What each wall is made of."),
          group("floor", surface_keys(), "What the floor is made of."),
          group("light", light_range_keys(), "Where light comes from, and how much of it."),
          group("clutter", clutter_keys(), "Boxes beside the drive."),
          group("distractors", distractor_keys(), "Things beside the drive, nearly of a ball's colour."),
          whole("balls_in_view", 0, 254, "Things leave so many balls in view at each step, at least.")
              .otherwise_says("what the world's generator promises, or 2"),
      }};
  return keys;
}

Randomisation read_randomisation(const YamlValue& value, int balls_in_view,
                                 const std::filesystem::path& folder) {
  const YamlMap map(value, randomisation_keys());
  Randomisation randomise{.balls_in_view = map.whole("balls_in_view", balls_in_view)};
  if (const auto colours = map.find("ball_colours")) randomise.ball_colours = read_ball_colours(*colours);
  if (const auto walls = map.find("walls")) randomise.walls = read_surface(*walls, folder);
  if (const auto floor = map.find("floor")) randomise.floor = read_surface(*floor, folder);
  if (const auto light = map.find("light")) randomise.light = read_light_ranges(*light);
  if (const auto clutter = map.find("clutter")) randomise.clutter = read_clutter(*clutter);
  if (const auto things = map.find("distractors")) randomise.distractors = read_distractors(*things);
  return randomise;
}

}  // namespace stereobench::worlds
