#include "renderer/truth/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace stereobench::renderer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a ray comes nearest to a ball's centre, and how much of the radius' square is left there.
struct Passage {
  double middle;
  double spare_m2;
};

Passage passage(const worlds::Ball& ball, const Ray& ray) {
  const Eigen::Vector3d to_centre = ball.centre_m - ray.origin_m;
  const double middle = to_centre.dot(ray.direction) / ray.direction.squaredNorm();
  const double apart_m2 = (to_centre - middle * ray.direction).squaredNorm();
  return {middle, ball.radius_m * ball.radius_m - apart_m2};
}

double entry(const Passage& passage, const Ray& ray) {
  return passage.middle - std::sqrt(std::max(passage.spare_m2, 0.0) / ray.direction.squaredNorm());
}

double clamped(double value) {
  return std::isnan(value) ? 0.0 : std::clamp(value, 0.0, 1.0);  // NaN: seen exactly from the side
}

Eigen::Vector3d position(const SurfaceVertex& vertex) {
  return Eigen::Vector3f(vertex.position).cast<double>();
}

}  // namespace

SceneGeometry::Flat::Flat(Shape of_shape, int of_surface, const Eigen::Vector3d& at,
                          const Eigen::Vector3d& one_way, const Eigen::Vector3d& other_way)
    : shape(of_shape), surface(of_surface), corner(at), along(one_way), up(other_way) {
  const Eigen::Vector3d area = along.cross(up);
  normal = area.stableNormalized();
  dual_along = up.cross(area) / area.squaredNorm();
  dual_up = area.cross(along) / area.squaredNorm();
}

std::vector<SceneGeometry::Flat> SceneGeometry::flats_of(const worlds::World& world, const FormReader& read) {
  std::vector<Flat> flats;
  flats.emplace_back(world.has_floor ? Shape::kPlane : Shape::kNothing, kFloorPrimitive,
                     Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  int surface = kFirstWallPrimitive;
  for (const worlds::Wall& wall : world.walls) {
    const Eigen::Vector2d run = wall.to_m - wall.from_m;
    flats.emplace_back(Shape::kParallelogram, surface++,
                       Eigen::Vector3d(wall.from_m.x(), wall.from_m.y(), 0.0),
                       Eigen::Vector3d(run.x(), run.y(), 0.0), wall.height_m * Eigen::Vector3d::UnitZ());
  }
  const MeshSurfaces meshes = place_meshes(world, read);
  for (const MeshRun& run : meshes.runs) {
    for (int i = run.first; i < run.first + run.count; i += 3) {
      const SurfaceVertex* corners = &meshes.vertices[static_cast<std::size_t>(i)];
      const Eigen::Vector3d corner = position(corners[0]);
      flats.emplace_back(Shape::kTriangle, surface + run.mesh, corner, position(corners[1]) - corner,
                         position(corners[2]) - corner);
    }
  }
  return flats;
}

SceneGeometry::SceneGeometry(const worlds::World& world, const FormReader& read)
    : balls_(world.balls), flats_(flats_of(world, read)), tree_(boxes_of(flats_)) {}

std::vector<Eigen::AlignedBox3d> SceneGeometry::boxes_of(const std::vector<Flat>& flats) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (auto flat = flats.begin() + 1; flat != flats.end(); ++flat) {
    Eigen::AlignedBox3d box(flat->corner);
    box.extend(flat->corner + flat->along);
    box.extend(flat->corner + flat->up);
    if (flat->shape == Shape::kParallelogram) box.extend(flat->corner + flat->along + flat->up);
    boxes.push_back(box);
  }
  return boxes;
}

double SceneGeometry::enter(int primitive, const Ray& ray) const {
  if (is_ball(primitive)) {
    const Passage past = passage(ball(primitive), ray);
    return past.spare_m2 > 0.0 && past.middle > 0.0 ? entry(past, ray) : kNever;
  }
  const Flat& plane = flat(primitive);
  const double depth = plane.normal.dot(plane.corner - ray.origin_m) / plane.normal.dot(ray.direction);
  if (!(depth > 0.0)) return kNever;
  const Eigen::Vector3d place = ray.origin_m + depth * ray.direction - plane.corner;
  return plane.contains(plane.dual_along.dot(place), plane.dual_up.dot(place)) ? depth : kNever;
}

int SceneGeometry::first_flat(const Ray& ray, double from, double before, int but_for) const {
  const auto enters = [&](int primitive) { return primitive == but_for ? kNever : enter(primitive, ray); };
  const double floor = enters(kFloorPrimitive);
  const bool on_floor = floor >= from && floor < before;
  const worlds::Bvh::Met met = tree_.first(ray, from, on_floor ? floor : before,
                                           [&](int thing) { return enters(kFirstWallPrimitive + thing); });
  return met.thing >= 0 ? kFirstWallPrimitive + met.thing : on_floor ? kFloorPrimitive : kNoPrimitive;
}

Eigen::Vector3d SceneGeometry::Flat::nearest(const Eigen::Vector3d& in_plane) const {
  double s = clamped(dual_along.dot(in_plane - corner));
  double t = clamped(dual_up.dot(in_plane - corner));
  if (shape == Shape::kTriangle && s + t > 1.0) {
    s = clamped(s - 0.5 * (s + t - 1.0));
    t = 1.0 - s;
  }
  return corner + s * along + t * up;
}

SceneGeometry::Seen SceneGeometry::seen_of(const worlds::Ball& ball, const Ray& ray) {
  const Eigen::Vector3d point = ray.origin_m + entry(passage(ball, ray), ray) * ray.direction;
  return {point, point};
}

SceneGeometry::Seen SceneGeometry::seen_beside(const Flat& flat, const Eigen::Vector3d& in_plane,
                                               const Ray& ray) {
  const Eigen::Vector3d nearest = flat.nearest(in_plane);
  const double beside = ray.direction.dot(nearest - ray.origin_m) / ray.direction.squaredNorm();
  return {nearest, ray.origin_m + beside * ray.direction};
}

Eigen::Vector3d SceneGeometry::normal_of(const worlds::Ball& ball, const Eigen::Vector3d& point_m) {
  return (point_m - ball.centre_m).stableNormalized();
}

}  // namespace stereobench::renderer
