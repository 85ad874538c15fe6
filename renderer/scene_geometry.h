/// The facets of a world as equations in double precision: where rays meet them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "renderer/facets.h"
#include "renderer/sightline.h"

namespace stereobench::renderer {

/// Everything that can be seen of a world. Meshes are read anew: a renderer keeps theirs in GL alone.
class SceneGeometry {
 public:
  /// @throws std::runtime_error as read_mesh
  explicit SceneGeometry(const worlds::World& world);

  /// The parameter at which a sightline enters a facet.
  /// @return +inf where it passes by, or meets it behind its origin, and for a floor that there is not
  double enter(int facet, const Sightline& sight) const;

  /// The point of a facet that a pixel's centre sees. The rasteriser snaps corners to 1/256 px and computes
  /// outlines in single precision: where the sightline just passes by, the facet's nearest point is taken.
  /// @param facet that is seen there, not kNoFacet
  Eigen::Vector3d seen_point(int facet, const Sightline& sight) const;

  /// The unit normal of a facet at one of its points, world frame: outwards for balls, either way for others.
  Eigen::Vector3d normal(int facet, const Eigen::Vector3d& point_m) const;

  /// The surface that a facet is of (facets.h).
  int surface(int facet) const;

 private:
  enum class Shape { kNothing, kPlane, kParallelogram, kTriangle };
  /// Points are corner + s along + t up; s and t are found with the dual vectors.
  struct Flat {
    Flat(Shape shape, int surface, const Eigen::Vector3d& corner, const Eigen::Vector3d& along,
         const Eigen::Vector3d& up);
    bool contains(double s, double t) const;
    Shape shape;
    int surface;
    Eigen::Vector3d corner, along, up, normal, dual_along, dual_up;
  };
  const Flat& flat(int facet) const { return flats_[static_cast<std::size_t>(facet - kFloorFacet)]; }
  const worlds::Ball& ball(int facet) const { return balls_[static_cast<std::size_t>(facet - 1)]; }

  std::vector<worlds::Ball> balls_;
  std::vector<Flat> flats_;  // the floor, walls, triangles
};

}  // namespace stereobench::renderer
