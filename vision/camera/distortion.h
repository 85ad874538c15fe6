/// What a lens and pixels that are not square do to a pinhole's picture: the model of Brown and Conrady, in
/// OpenCV's form.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "vision/types.h"

namespace stereobench::vision {

/// Where light of a direction arrives: (x, y) (1 + k1 r^2 + k2 r^4 + k3 r^6), and beside it
/// (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y); y is then multiplied by the pixels' aspect.
/// @param direction (X / Z, Y / Z) in the camera's frame
/// @return the place at focal length 1
Eigen::Vector2d distort(const Distortion& lens, const Eigen::Vector2d& direction);

/// How places change with directions, d place / d direction.
Eigen::Matrix2d distortion_slope(const Distortion& lens, const Eigen::Vector2d& direction);

/// Where light came from, by Newton's method.
/// @param place at focal length 1
/// @param start a direction nearby
/// @return the direction; empty where none is found, or where the picture is folded over itself
std::optional<Eigen::Vector2d> undistort(const Distortion& lens, const Eigen::Vector2d& place,
                                         const Eigen::Vector2d& start);

/// The same from the picture's centre outwards, for places far from any direction that is known.
std::optional<Eigen::Vector2d> undistort(const Distortion& lens, const Eigen::Vector2d& place);

/// How far to the side, or up and down, of its axis a camera may look: the tangent of 80 degrees.
inline constexpr double kWidestTangent = 5.67;

/// Directions that points along the picture's border see.
/// @return empty where some point has no direction of its own, or lies more than 80 degrees off the axis
std::optional<std::vector<Eigen::Vector2d>> border_directions(const Distortion& lens,
                                                              const Intrinsics& camera);

/// What a camera sees: bounds of the directions along its picture's border.
/// @return empty where border_directions() is
std::optional<Eigen::AlignedBox2d> directions_seen(const Distortion& lens, const Intrinsics& camera);

}  // namespace stereobench::vision
