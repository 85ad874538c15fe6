/// The primitives of a world as equations in double precision: where rays meet them. What each pixel asks
/// is defined here, since calls would cost as much as the answers.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "renderer/surfaces/mesh_surfaces.h"
#include "renderer/surfaces/primitives.h"
#include "renderer/truth/ray.h"
#include "worlds/visibility/bvh.h"

namespace stereobench::renderer {

/// Everything that can be seen of a world.
class SceneGeometry {
 public:
  /// @param read meshes; those of a renderer lie in GL alone, a MeshCache serves both
  /// @throws std::runtime_error as read_form
  explicit SceneGeometry(const worlds::World& world, const FormReader& read = read_form);

  /// The parameter at which a ray enters a primitive.
  /// @return +inf where it passes by, or meets it behind its origin, and for a floor that there is not
  double enter(int primitive, const Ray& ray) const;

  /// The wall, triangle or floor that a ray enters first; balls are passed over.
  /// @param from,before the parameters between which it is looked at
  /// @param but_for a primitive that does not count
  /// @return kNoPrimitive where it meets none
  int first_flat(const Ray& ray, double from, double before, int but_for = kNoPrimitive) const;

  /// What a pixel's centre sees of a primitive. The rasteriser snaps corners to 1/256 px and computes
  /// outlines in single precision: where the ray just passes by, the primitive's nearest point is taken.
  struct Seen {
    Eigen::Vector3d on_primitive;
    Eigen::Vector3d on_ray;  ///< the same point, or where the ray comes nearest to it
  };
  /// @param primitive that is seen there, not kNoPrimitive
  Seen seen(int primitive, const Ray& ray) const;

  /// The same of a floor, wall or triangle for many rays of one camera.
  class FlatLook;
  /// The same along a row of a picture without distortion (flat_row.h).
  class FlatRow;

  /// The unit normal of a primitive at one of its points, world frame: outwards for balls, either way for
  /// others.
  Eigen::Vector3d normal(int primitive, const Eigen::Vector3d& point_m) const {
    return is_ball(primitive) ? normal_of(ball(primitive), point_m) : flat(primitive).normal;
  }

  /// The surface that a primitive is of (primitives.h).
  int surface(int primitive) const {
    return primitive < kFloorPrimitive ? primitive : flat(primitive).surface;
  }

 private:
  enum class Shape { kNothing, kPlane, kParallelogram, kTriangle };
  /// Points are corner + s along + t up; s and t are found with the dual vectors.
  struct Flat {
    Flat(Shape shape, int surface, const Eigen::Vector3d& corner, const Eigen::Vector3d& along,
         const Eigen::Vector3d& up);
    bool contains(double s, double t) const { return contains(shape, s, t); }
    static bool contains(Shape shape, double s, double t) {
      if (shape == Shape::kPlane || shape == Shape::kNothing) return shape == Shape::kPlane;
      if (!(s >= 0.0 && t >= 0.0)) return false;
      return shape == Shape::kTriangle ? s + t <= 1.0 : s <= 1.0 && t <= 1.0;
    }
    /// The point of the primitive that is taken for one of its plane which is not on it.
    Eigen::Vector3d nearest(const Eigen::Vector3d& in_plane) const;
    Shape shape;
    int surface;
    Eigen::Vector3d corner, along, up, normal, dual_along, dual_up;
  };
  static Seen seen_of(const worlds::Ball& ball, const Ray& ray);
  static Eigen::Vector3d normal_of(const worlds::Ball& ball, const Eigen::Vector3d& point_m);
  /// What is seen of a flat whose plane is met beside it. @param in_plane where
  static Seen seen_beside(const Flat& flat, const Eigen::Vector3d& in_plane, const Ray& ray);
  static std::vector<Flat> flats_of(const worlds::World& world, const FormReader& read);
  static std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<Flat>& flats);
  const Flat& flat(int primitive) const {
    return flats_[static_cast<std::size_t>(primitive - kFloorPrimitive)];
  }
  const worlds::Ball& ball(int primitive) const { return balls_[static_cast<std::size_t>(primitive - 1)]; }

  std::vector<worlds::Ball> balls_;
  std::vector<Flat> flats_;  // the floor, walls, triangles
  worlds::Bvh tree_;         // of all flats but the floor
};

class SceneGeometry::FlatLook {
 public:
  /// @param primitive that is no ball
  /// @param camera_m where all rays begin
  FlatLook(const SceneGeometry& scene, int primitive, const Eigen::Vector3d& camera_m)
      : FlatLook(scene.flat(primitive), camera_m) {}

  Seen seen(const Ray& ray) const {
    const double depth = ahead_m_ / normal_.dot(ray.direction);
    const Eigen::Vector3d point = ray.origin_m + depth * ray.direction;
    const Eigen::Vector3d place = point - corner_m_;
    if (Flat::contains(shape_, dual_along_.dot(place), dual_up_.dot(place))) return {point, point};
    return seen_beside(whole_, point, ray);
  }

  const Eigen::Vector3d& normal() const { return normal_; }

 private:
  FlatLook(const Flat& flat, const Eigen::Vector3d& camera_m)
      : whole_(flat),
        shape_(flat.shape),
        corner_m_(flat.corner),
        normal_(flat.normal),
        dual_along_(flat.dual_along),
        dual_up_(flat.dual_up),
        ahead_m_(flat.normal.dot(flat.corner - camera_m)) {}

  const Flat& whole_;
  // Copies: in registers, where pixels are written that might lie where the flat does.
  Shape shape_;
  Eigen::Vector3d corner_m_, normal_, dual_along_, dual_up_;
  double ahead_m_;  ///< along the normal
};

inline SceneGeometry::Seen SceneGeometry::seen(int primitive, const Ray& ray) const {
  return is_ball(primitive) ? seen_of(ball(primitive), ray)
                            : FlatLook(*this, primitive, ray.origin_m).seen(ray);
}

}  // namespace stereobench::renderer
