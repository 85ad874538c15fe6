/// A world's floor plan with the drive through it and what the robot sees on its way, as SVG.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "renderer/surfaces/mesh_surfaces.h"
#include "worlds/drive/wall_crossings.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What is in view along a drive.
struct ViewCoverage {
  std::vector<int> balls_in_view;  ///< for each step of the path
  std::vector<int> steps_seen;     ///< for each ball
};

/// @param world its meshes of files with their occluders
ViewCoverage view_coverage(const worlds::Scenario& scenario, const worlds::World& world);

/// A line on the floor, metres.
struct FloorLine {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();
  bool hides = true;  ///< what it stands for reaches above the cameras
};

/// The outlines of the meshes, cut level with the cameras, or at half their height where they are lower.
/// @throws std::runtime_error when a mesh file cannot be read
std::vector<FloorLine> mesh_outlines(const worlds::World& world, double camera_height_m,
                                     const renderer::FormReader& read = renderer::read_form);

/// Where the drive goes through a wall, or through the outline of a mesh that reaches above the cameras.
std::vector<worlds::Crossing> drive_crossings(const worlds::World& world, const worlds::GroundTruth& path,
                                              std::span<const FloorLine> outlines);

/// The indices of the balls that are in view at no step.
std::vector<int> never_in_view(const ViewCoverage& coverage);

/// Walls, outlines of meshes, balls in their colours with their indices (crossed out where never in view),
/// the drive coloured by how many balls are in view, sectors of view along it and crosses where it goes
/// through something, on a grid with coordinates in metres.
/// @return an SVG document, the same bytes for the same arguments
std::string draw_plan(const worlds::Scenario& scenario, const worlds::World& world,
                      const ViewCoverage& coverage, std::span<const FloorLine> outlines);

}  // namespace stereobench::harness
