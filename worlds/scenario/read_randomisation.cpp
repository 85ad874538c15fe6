#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {

/// A range is [least, most], or one number for both.
template <>
inline constexpr std::size_t kListLength<Range> = 2;
template <>
inline constexpr bool kOneForAll<Range> = true;

static void read_value(const YamlValue& value, const Key& key, Range& range) {
  Eigen::Vector2d bounds;
  read_value(value, key, bounds);
  if (bounds[0] > bounds[1]) value.refuse("expected the least first: [least, most]");
  range = {bounds[0], bounds[1]};
}

static YAML::Node written(const Key& key, const Range& range) {
  return written(key, Eigen::Vector2d(range.least, range.most));
}

namespace {

constexpr Interval kShade = {0.0, 2.0};
constexpr Interval kTintOffset = {-1.0, 1.0};
constexpr Interval kClutterSize_m = {1e-3, 10.0};
constexpr Interval kAway_m = {0.0, 100.0};
constexpr Interval kUp_deg = {-90.0, 90.0};

constexpr std::string_view kOfColour = "Part of the colour that each channel is brighter by.";

Key shade() {
  return number("shade", kShade, "Factor on the colour.");
}

Key tint(std::string_view says) {
  return number("tint", kTintOffset, says);
}

Key materials() {
  return choice("materials", {kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials},
                "Materials that one is drawn from.")
      .list(1, 100);
}

/// The keys of things beside the drive, and then some.
template <class Things>
std::vector<Field<Things>> scattered_fields(std::vector<Field<Things>> more) {
  std::vector<Field<Things>> fields = lifted(
      &Things::scattered,
      {
          whole("count", 0, 1000, "How many things there are.").fills(&Scattered::count),
          number("size_m", kClutterSize_m, "Sides of a box, or a ball's diameter, in metres.")
              .fills(&Scattered::size_m),
          number("range_m", kAway_m, "Distance from a step of the drive to a thing's middle, in metres.")
              .fills(&Scattered::range_m),
          number("bearing_deg", kTurn_deg, "Direction of a thing from that step, in degrees to the left.")
              .fills(&Scattered::bearing_deg),
          number("clearance_m", kAway_m, "Distance between the drive and a thing, in metres.")
              .fills(&Scattered::clearance_m),
      });
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

/// Where textures are named and materials are not, there are textures alone.
void check_surface(const YamlMap& map, SurfaceLooks& looks) {
  if (!looks.textures.empty() && !map.find("materials")) looks.materials.clear();
}

}  // namespace

const Fields<SurfaceLooks>& surface_keys() {
  static const Fields<SurfaceLooks> keys(
      {
          materials()
              .otherwise_says("[plain, plaster, bricks, wood, tiles], or none beside textures")
              .fills(&SurfaceLooks::materials),
          group("textures", surface_texture_keys(), "Pictures, each as likely as a material.")
              .list(1, 100)
              .fills(&SurfaceLooks::textures),
          shade().fills(&SurfaceLooks::shade),
          tint(kOfColour).fills(&SurfaceLooks::tint),
      },
      check_surface);
  return keys;
}

const Fields<BallColours>& ball_colour_keys() {
  static const Fields<BallColours> keys({
      flag("shuffle", "Whether the palette's colours change places.").fills(&BallColours::shuffle),
      shade().fills(&BallColours::shade),
      tint("What is added to each channel, as a part of full light.").fills(&BallColours::tint),
  });
  return keys;
}

const Fields<LightRanges>& light_range_keys() {
  static const Fields<LightRanges> keys({
      number("azimuth_deg", kTurn_deg, "Where light comes from, in degrees from east to north.")
          .fills(&LightRanges::azimuth_deg),
      number("elevation_deg", kUp_deg, "How high it stands, in degrees.").fills(&LightRanges::elevation_deg),
      number("ambient", kShare, "Light that comes from everywhere.").fills(&LightRanges::ambient),
      number("diffuse", kShare, "Light that falls at a right angle.").fills(&LightRanges::diffuse),
  });
  return keys;
}

const Fields<Clutter>& clutter_keys() {
  static const Fields<Clutter> keys(scattered_fields<Clutter>({
      materials().fills(&Clutter::looks, &SurfaceLooks::materials),
      shade().fills(&Clutter::looks, &SurfaceLooks::shade),
      tint(kOfColour).fills(&Clutter::looks, &SurfaceLooks::tint),
  }));
  return keys;
}

const Fields<Distractors>& distractor_keys() {
  static const Fields<Distractors> keys(scattered_fields<Distractors>({
      choice("shapes", {kShapeNames.begin(), kShapeNames.end()}, "Shapes that one is drawn from.")
          .starting_at(static_cast<int>(MeshShape::kBox))
          .list(1, 100)
          .fills(&Distractors::shapes),
      shade().fills(&Distractors::shade),
      tint("What is added to each channel of a ball's colour, as a part of full light.")
          .fills(&Distractors::tint),
  }));
  return keys;
}

const Fields<Randomisation>& randomisation_keys() {
  static const Fields<Randomisation> keys({
      group("ball_colours", ball_colour_keys(), "Paint = shade x the palette's colour + tint.")
          .fills(&Randomisation::ball_colours),
      group("walls", surface_keys(), "What each wall is made of.").fills(&Randomisation::walls),
      group("floor", surface_keys(), "What the floor is made of.").fills(&Randomisation::floor),
      group("light", light_range_keys(), "Where light comes from, and how much of it.")
          .fills(&Randomisation::light),
      group("clutter", clutter_keys(), "Boxes beside the drive.").fills(&Randomisation::clutter),
      group("distractors", distractor_keys(), "Things beside the drive, nearly of a ball's colour.")
          .fills(&Randomisation::distractors),
      whole("balls_in_view", 0, 254, "Things leave so many balls in view at each step, at least.")
          .otherwise_says("what the world's generator promises, or 2")
          .fills(&Randomisation::balls_in_view),
  });
  return keys;
}

}  // namespace stereobench::worlds
