/// What a scenario leaves to chance beside the places of its balls: each seed draws it anew.
#pragma once

#include <optional>
#include <vector>

#include "worlds/materials.h"

namespace stereobench::worlds {

/// From where to where a number is drawn, uniformly.
struct Range {
  double least = 0.0;
  double most = 0.0;
};

/// Balls: paint = shade x the palette's colour + tint in each channel.
struct BallColours {
  bool shuffle = true;  ///< the palette's colours change places: who looks alike stays alike
  Range shade = {0.8, 1.0};
  Range tint = {0.0, 0.05};  ///< of full light, drawn for each channel
};

/// Walls, the floor, clutter: a material or a texture, its colours times shade x (1 + tint) in each channel.
struct SurfaceLooks {
  std::vector<Material> materials = {Material::kPlain, Material::kPlaster, Material::kBricks, Material::kWood,
                                     Material::kTiles};
  std::vector<SurfaceTexture> textures = {};  ///< not of clutter
  Range shade = {0.7, 1.1};
  Range tint = {-0.1, 0.1};
};

struct LightRanges {
  Range azimuth_deg = {-180.0, 180.0};  ///< where it comes from, from east to north
  Range elevation_deg = {20.0, 80.0};
  Range ambient = {0.35, 0.55};
  Range diffuse = {0.3, 0.45};  ///< with the most of both white stays white
};

/// Things on the floor beside the drive.
struct Scattered {
  Range count = {3.0, 8.0};    ///< whole
  Range size_m = {0.15, 0.5};  ///< of each side of a box; a ball's diameter
  Range range_m = {0.5, 3.0};  ///< from a step of the drive to a thing's middle
  Range bearing_deg = {-180.0, 180.0};
  double clearance_m = 0.4;  ///< between the drive and a thing
};

/// Boxes.
struct Clutter {
  Scattered scattered;
  SurfaceLooks looks;
};

/// What could be taken for a ball: paint = shade x a colour of the palette + tint in each channel.
struct Distractors {
  Scattered scattered = {.count = {2.0, 5.0}, .size_m = {0.05, 0.3}};
  std::vector<MeshShape> shapes = {MeshShape::kBox, MeshShape::kBall};
  Range shade = {0.7, 1.0};
  Range tint = {-0.1, 0.1};
};

/// What is empty stays as the scenario says.
struct Randomisation {
  std::optional<BallColours> ball_colours;
  std::optional<SurfaceLooks> walls;  ///< each wall its own
  std::optional<SurfaceLooks> floor;
  std::optional<LightRanges> light;
  std::optional<Clutter> clutter;
  std::optional<Distractors> distractors;
  int balls_in_view =
      2;  ///< what is scattered leaves so many in view at each step, or all where there are fewer
};

}  // namespace stereobench::worlds
