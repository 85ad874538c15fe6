/// Renders what a stereo rig sees of a world, with the truth behind each pixel, without a screen.
#pragma once

#include <memory>

#include "renderer/surfaces/mesh_surfaces.h"
#include "renderer/truth/id_buffer.h"
#include "renderer/types.h"
#include "slam/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// Owns a GL context and everything of the world that GL must know. Move-only; several may live in one
/// process, each used by the thread that made it: more speed takes more processes.
class Renderer {
 public:
  /// @throws std::runtime_error when there is no GL to render with or a mesh file cannot be read
  /// @throws std::invalid_argument when the rig cannot be computed with, or a ball, wall, mesh or light of
  ///   the world is not finite, has no size, or there are more than 254 balls
  /// @param depth of the light in its pictures: expose.h says which cameras need more than eight bits
  /// @param read meshes
  Renderer(const worlds::World& world, const vision::StereoRig& rig, Backend backend = Backend::kSoftware,
           LightDepth depth = LightDepth::kEightBits, const FormReader& read = read_form);
  ~Renderer();
  Renderer(Renderer&& other) noexcept;
  Renderer& operator=(Renderer&& other) noexcept;

  /// What both cameras see. Balls are exact: shape, depth, shading and the share of each edge pixel that they
  /// cover. A ball that reaches behind the near plane (1 cm ahead of a camera) is not drawn in that camera.
  /// @param world_from_robot where the robot stands
  /// @return the same bytes for the same pose, whatever was rendered before
  /// @throws std::invalid_argument when the pose is not finite
  StereoFrame render(const slam::Pose& world_from_robot) {
    return render(world_from_robot, world_from_robot);
  }

  /// The same with cameras that open at different times.
  /// @param left_pose, right_pose where the robot stands when the camera looks
  StereoFrame render(const slam::Pose& left_pose, const slam::Pose& right_pose) {
    return render(left_pose, right_pose, cv::Range::all());
  }

  /// Of the pictures that it renders.
  int height_px() const;

  /// That it renders for.
  const vision::StereoRig& rig() const;

  /// The same for cameras whose rows look one after another.
  /// @param rows of the picture, those that look now
  /// @return pictures of these rows alone
  /// @throws std::invalid_argument also when the pictures have no such rows
  StereoFrame render(const slam::Pose& left_pose, const slam::Pose& right_pose, const cv::Range& rows);

  /// Which primitive of the world each pixel of render() sees, in place of its colour; asked for by those who
  /// want more truth than a frame carries (pixel_truth.h, correspondence.h).
  /// @param rows of the picture, those that look now; the views are of a picture of these alone
  ///
  /// Behind a lens that distorts they are those of the rig's pinhole (lens.h), from which distorted_ids.h
  /// makes the lens' own; then all rows are asked for.
  /// @throws std::invalid_argument as render
  StereoIdBuffers id_buffers(const slam::Pose& left_pose, const slam::Pose& right_pose,
                             const cv::Range& rows = cv::Range::all());

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace stereobench::renderer
