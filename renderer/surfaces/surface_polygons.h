/// The flat parts of a world as a camera sees them: walls and the floor, cut to the picture.
///
/// The cutting is done here in double precision, because GL would interpolate the corners it cuts in single
/// precision, which a floor that reaches the horizon would show in its depth.
#pragma once

#include <vector>

#include "renderer/camera/camera_view.h"
#include "renderer/surfaces/primitives.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// A corner as the surface shader reads it.
struct SurfaceVertex {
  float position[4];  ///< clip space for polygons that are already cut; world frame and 1 for meshes
  float along_m[2];   ///< place on the material: along and up a wall, east and north on the floor; in texels
                      ///< on a texture
  float light;        ///< Lambert's law plus the ambient part, >= 0
  float colour[3] = {1.0F, 1.0F, 1.0F};  ///< of corners that have their own
};
inline constexpr int kSurfaceVertexFloats = 10;

/// How far the floor goes on around the camera: seen from its height, nearer to the horizon than half a
/// pixel.
inline constexpr double kFloorReach_m = 10000.0;

/// A convex polygon in the picture.
struct SurfacePolygon {
  worlds::Material material = worlds::Material::kPlain;
  Eigen::Vector3f tint_rgb = Eigen::Vector3f::Ones();  ///< factors on its colours
  int primitive = kNoPrimitive;
  std::vector<SurfaceVertex> corners;  ///< in order around it; none when the camera does not see it
  double nearest_m = 0.0;              ///< smallest Z of the corners
  bool runs_left = false;              ///< a wall whose first corner is on the right, as the camera sees it
};

/// How brightly a surface with this outward unit normal (world frame) is lit.
double lit(const worlds::Light& light, const Eigen::Vector3d& normal);

/// What the camera sees of the walls, near ones first, and of the floor, last: the order in which the least
/// is painted twice.
std::vector<SurfacePolygon> visible_polygons(const CameraView& view, const worlds::World& world);

}  // namespace stereobench::renderer
