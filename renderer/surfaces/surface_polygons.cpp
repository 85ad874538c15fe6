#include "renderer/surfaces/surface_polygons.h"

#include <algorithm>

namespace stereobench::renderer {
namespace {

struct Corner {
  Eigen::Vector3d in_camera;
  Eigen::Vector2d along_m;
};

/// The part of a convex polygon on the inner side of a plane (Sutherland and Hodgman).
std::vector<Corner> cut(const std::vector<Corner>& corners, const Eigen::Vector4d& plane) {
  std::vector<Corner> inside;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& a = corners[i];
    const Corner& b = corners[(i + 1) % corners.size()];
    const double height_a = plane.dot(a.in_camera.homogeneous());
    const double height_b = plane.dot(b.in_camera.homogeneous());
    if (height_a >= 0.0) inside.push_back(a);
    if ((height_a >= 0.0) == (height_b >= 0.0)) continue;
    const double t = height_a / (height_a - height_b);
    inside.push_back(
        {a.in_camera + t * (b.in_camera - a.in_camera), a.along_m + t * (b.along_m - a.along_m)});
  }
  return inside;
}

SurfaceVertex vertex(const CameraView& view, const Corner& corner, double light) {
  const Eigen::Vector4f clip = clip_point(view.intrinsics, corner.in_camera).cast<float>();
  const Eigen::Vector2f along = corner.along_m.cast<float>();
  return {{clip.x(), clip.y(), clip.z(), clip.w()}, {along.x(), along.y()}, static_cast<float>(light)};
}

SurfacePolygon polygon(const CameraView& view, std::vector<Corner> corners, worlds::Material material,
                       double light) {
  for (const Eigen::Vector4d& plane : frustum_in_camera(view.intrinsics)) corners = cut(corners, plane);
  SurfacePolygon result{.material = material};
  if (corners.size() < 3) return result;
  result.nearest_m = corners.front().in_camera.z();
  for (const Corner& corner : corners) {
    result.corners.push_back(vertex(view, corner, light));
    result.nearest_m = std::min(result.nearest_m, corner.in_camera.z());
  }
  return result;
}

SurfacePolygon wall_polygon(const CameraView& view, const worlds::Wall& wall, const worlds::Light& light) {
  const Eigen::Vector2d run = wall.to_m - wall.from_m;
  const double length_m = run.norm();
  const auto corner = [&](const Eigen::Vector2d& foot, double along_m, double up_m) {
    return Corner{view.camera_from_world * Eigen::Vector3d(foot.x(), foot.y(), up_m), {along_m, up_m}};
  };
  Eigen::Vector3d normal(-run.y(), run.x(), 0.0);
  const Eigen::Vector3d foot(wall.from_m.x(), wall.from_m.y(), 0.0);
  const bool runs_left = normal.dot(view.centre_in_world() - foot) >= 0.0;
  if (!runs_left) normal = -normal;  // both sides can be seen
  SurfacePolygon seen =
      polygon(view,
              {corner(wall.from_m, 0.0, 0.0), corner(wall.to_m, length_m, 0.0),
               corner(wall.to_m, length_m, wall.height_m), corner(wall.from_m, 0.0, wall.height_m)},
              wall.material, lit(light, normal.stableNormalized()));
  seen.runs_left = runs_left;
  return seen;
}

SurfacePolygon floor_polygon(const CameraView& view, const worlds::World& world) {
  const Eigen::Vector2d camera_m = view.centre_in_world().head<2>();
  const auto corner = [&](double east, double north) {
    const Eigen::Vector2d place = camera_m + kFloorReach_m * Eigen::Vector2d(east, north);
    return Corner{view.camera_from_world * Eigen::Vector3d(place.x(), place.y(), 0.0), place};
  };
  return polygon(view, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, world.floor,
                 lit(world.light, Eigen::Vector3d::UnitZ()));
}

}  // namespace

double lit(const worlds::Light& light, const Eigen::Vector3d& normal) {
  return light.ambient + light.diffuse * std::max(0.0, normal.dot(light.towards_light.normalized()));
}

std::vector<SurfacePolygon> visible_polygons(const CameraView& view, const worlds::World& world) {
  std::vector<SurfacePolygon> polygons;
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    SurfacePolygon seen = wall_polygon(view, world.walls[i], world.light);
    seen.primitive = kFirstWallPrimitive + static_cast<int>(i);
    seen.tint_rgb = world.walls[i].tint_rgb.cast<float>();
    if (!seen.corners.empty()) polygons.push_back(std::move(seen));
  }
  std::stable_sort(polygons.begin(), polygons.end(), [](const SurfacePolygon& a, const SurfacePolygon& b) {
    return a.nearest_m < b.nearest_m;
  });
  if (!world.has_floor) return polygons;
  SurfacePolygon floor = floor_polygon(view, world);
  floor.primitive = kFloorPrimitive;
  floor.tint_rgb = world.floor_tint_rgb.cast<float>();
  if (!floor.corners.empty()) polygons.push_back(std::move(floor));
  return polygons;
}

}  // namespace stereobench::renderer
