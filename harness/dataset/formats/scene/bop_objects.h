/// Balls as objects of BOP.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "worlds/types.h"

namespace stereobench::harness {

inline constexpr double kMmPerMetre = 1000.0;

/// The objects that balls are: one for each colour and radius, in order of the balls.
class BopObjects {
 public:
  explicit BopObjects(const worlds::World& world);

  /// The object of a ball, from 1.
  int object_of(std::size_t ball) const { return object_of_ball_[ball]; }

  /// A ball of each object.
  const std::vector<worlds::Ball>& balls() const { return balls_; }

 private:
  std::vector<worlds::Ball> balls_;
  std::vector<int> object_of_ball_;
};

/// A sphere as a mesh of triangles: an icosahedron of which each side is divided into 256.
/// @return PLY, text; mm, normals, and the ball's paint
std::string sphere_ply(const worlds::Ball& ball);

/// An object's entry of models_info.json: diameter, box and symmetries, mm.
nlohmann::ordered_json sphere_info(const worlds::Ball& ball);

}  // namespace stereobench::harness
