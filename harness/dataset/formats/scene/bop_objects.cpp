#include "harness/dataset/formats/scene/bop_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

using Triangle = std::array<std::size_t, 3>;

struct UnitSphere {
  std::vector<Eigen::Vector3d> corners;
  std::vector<Triangle> triangles;  ///< anticlockwise from outside
};

UnitSphere icosahedron() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  UnitSphere sphere;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const int axis : {0, 1, 2}) {
        Eigen::Vector3d corner = Eigen::Vector3d::Zero();
        corner[(axis + 1) % 3] = a;
        corner[(axis + 2) % 3] = b;
        sphere.corners.push_back(corner.normalized());
      }
  const double side = 2.0 / std::sqrt(1.0 + golden * golden);
  const auto are_neighbours = [&](std::size_t i, std::size_t j) {
    return (sphere.corners[i] - sphere.corners[j]).norm() < 1.1 * side;
  };
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j)
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!are_neighbours(i, j) || !are_neighbours(j, k) || !are_neighbours(i, k)) continue;
        const Eigen::Vector3d& at = sphere.corners[i];
        const bool is_outside = (sphere.corners[j] - at).cross(sphere.corners[k] - at).dot(at) > 0.0;
        sphere.triangles.push_back(is_outside ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  return sphere;
}

/// Four triangles for each one.
UnitSphere divided(UnitSphere sphere) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t i, std::size_t j) {
    const auto [known, is_new] = middles.try_emplace(std::minmax(i, j), sphere.corners.size());
    if (is_new) sphere.corners.push_back((sphere.corners[i] + sphere.corners[j]).normalized());
    return known->second;
  };
  std::vector<Triangle> parts;
  for (const auto& [a, b, c] : sphere.triangles) {
    const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  sphere.triangles = parts;
  return sphere;
}

}  // namespace

BopObjects::BopObjects(const worlds::World& world) {
  for (const worlds::Ball& ball : world.balls) {
    const auto same = std::ranges::find_if(balls_, [&](const worlds::Ball& other) {
      return other.colour == ball.colour && other.radius_m == ball.radius_m;
    });
    object_of_ball_.push_back(static_cast<int>(same - balls_.begin()) + 1);
    if (same == balls_.end()) balls_.push_back(ball);
  }
}

std::string sphere_ply(const worlds::Ball& ball) {
  UnitSphere sphere = icosahedron();
  for (int i = 0; i < 4; ++i) sphere = divided(std::move(sphere));
  const Eigen::Vector3d rgb = 255.0 * worlds::paint_of(ball);
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      sphere.corners.size(), sphere.triangles.size());
  for (const Eigen::Vector3d& normal : sphere.corners) {
    const Eigen::Vector3d at_mm = kMmPerMetre * ball.radius_m * normal;
    text += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {} {} {}\n", at_mm.x(), at_mm.y(),
                        at_mm.z(), normal.x(), normal.y(), normal.z(), std::lround(rgb.x()),
                        std::lround(rgb.y()), std::lround(rgb.z()));
  }
  for (const auto& [a, b, c] : sphere.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

nlohmann::ordered_json sphere_info(const worlds::Ball& ball) {
  const double radius_mm = kMmPerMetre * ball.radius_m, diameter_mm = 2.0 * radius_mm;
  nlohmann::ordered_json symmetries = nlohmann::ordered_json::array();
  for (int axis = 0; axis < 3; ++axis)
    symmetries.push_back(
        {{"axis", {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}}, {"offset", {0, 0, 0}}});
  return {{"diameter", diameter_mm}, {"min_x", -radius_mm},
          {"min_y", -radius_mm},     {"min_z", -radius_mm},
          {"size_x", diameter_mm},   {"size_y", diameter_mm},
          {"size_z", diameter_mm},   {"symmetries_continuous", symmetries}};
}

}  // namespace stereobench::harness
