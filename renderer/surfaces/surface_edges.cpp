#include "renderer/surfaces/surface_edges.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace stereobench::renderer {
namespace {

constexpr double kRound_cos =
    0.94;  ///< of the angle up to which faces are parts of one round surface: 20 deg
constexpr double kFlat_cos = 1.0 - 1e-6;  ///< and of that up to which they are one face

/// One side of a face, by the places of its ends in the order of their coordinates.
struct FaceSide {
  std::array<float, 6> ends;  ///< in single precision, by which ends are the same
  Eigen::Vector3d first_m, last_m;
  Eigen::Vector3d inner_m;
};

FaceSide side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& inner_m) {
  const Eigen::Vector3f p = a.cast<float>(), q = b.cast<float>();
  if (!std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end()))
    return {{q.x(), q.y(), q.z(), p.x(), p.y(), p.z()}, b, a, inner_m};
  return {{p.x(), p.y(), p.z(), q.x(), q.y(), q.z()}, a, b, inner_m};
}

/// Cosine of the angle by which a surface bends where two faces meet; 1 when they go on straight.
double bend_cos(const FaceSide& a, const FaceSide& b) {
  const Eigen::Vector3d along = a.last_m - a.first_m;
  const Eigen::Vector3d normal_a = along.cross(a.inner_m - a.first_m);
  const Eigen::Vector3d normal_b = (b.inner_m - b.first_m).cross(along);
  return normal_a.dot(normal_b) / std::sqrt(normal_a.squaredNorm() * normal_b.squaredNorm());
}

SurfaceEdge edge(const FaceSide& only) {
  return {only.first_m, only.last_m, {only.inner_m, only.inner_m}};
}

/// Joins sides that lie on each other two by two.
/// @param are_round whether faces that hardly bend are one surface; walls may have other materials
std::vector<SurfaceEdge> joined(std::vector<FaceSide> sides, bool are_round) {
  std::stable_sort(sides.begin(), sides.end(),
                   [](const FaceSide& a, const FaceSide& b) { return a.ends < b.ends; });
  std::vector<SurfaceEdge> edges;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    while (next < sides.size() && sides[next].ends == sides[i].ends) ++next;
    if (next - i != 2) {
      for (std::size_t k = i; k < next; ++k) edges.push_back(edge(sides[k]));
      continue;
    }
    const double bend = bend_cos(sides[i], sides[i + 1]);
    if (are_round && bend > kFlat_cos) continue;
    SurfaceEdge both = edge(sides[i]);
    both.inner_m[1] = sides[i + 1].inner_m;
    both.faces = 2;
    both.is_smooth = are_round && bend > kRound_cos;
    edges.push_back(both);
  }
  return edges;
}

std::vector<SurfaceEdge> wall_edges(const std::vector<worlds::Wall>& walls) {
  std::vector<FaceSide> sides;
  for (const worlds::Wall& wall : walls) {
    const auto corner = [&](const Eigen::Vector2d& foot, double up_m) {
      return Eigen::Vector3d(foot.x(), foot.y(), up_m);
    };
    const std::array<Eigen::Vector3d, 4> corners = {corner(wall.from_m, 0.0), corner(wall.to_m, 0.0),
                                                    corner(wall.to_m, wall.height_m),
                                                    corner(wall.from_m, wall.height_m)};
    for (std::size_t i = 0; i < 4; ++i)
      sides.push_back(side(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]));
  }
  return joined(std::move(sides), false);
}

std::vector<SurfaceEdge> mesh_edges(const MeshSurfaces& meshes, const MeshRun& run) {
  std::vector<FaceSide> sides;
  for (int i = run.first; i < run.first + run.count; i += 3) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = Eigen::Vector3f(meshes.vertices[static_cast<std::size_t>(i) + k].position).cast<double>();
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).isZero(0.0)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back(side(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]));
  }
  return joined(std::move(sides), true);
}

}  // namespace

std::vector<EdgeGroup> surface_edges(const worlds::World& world, const MeshSurfaces& meshes) {
  std::vector<EdgeGroup> groups;
  groups.push_back({std::nullopt, wall_edges(world.walls)});
  for (const MeshRun& run : meshes.runs) groups.push_back({run, mesh_edges(meshes, run)});
  return groups;
}

std::array<SurfaceEdge, 4> floor_edges(const Eigen::Vector3d& camera_m) {
  const Eigen::Vector3d foot(camera_m.x(), camera_m.y(), 0.0);
  const auto corner = [&](double east, double north) {
    return Eigen::Vector3d(foot + kFloorReach_m * Eigen::Vector3d(east, north, 0.0));
  };
  const auto edge_between = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return SurfaceEdge{a, b, {foot, foot}};
  };
  return {edge_between(corner(-1, -1), corner(1, -1)), edge_between(corner(1, -1), corner(1, 1)),
          edge_between(corner(1, 1), corner(-1, 1)), edge_between(corner(-1, 1), corner(-1, -1))};
}

}  // namespace stereobench::renderer
