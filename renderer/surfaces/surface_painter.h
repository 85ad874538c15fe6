/// Draws what is not a ball: meshes, walls and the floor.
#pragma once

#include <array>
#include <optional>

#include "renderer/gl/gl_objects.h"
#include "renderer/surfaces/material_shader.h"
#include "renderer/surfaces/surface_textures.h"
#include "renderer/textures/mip_chain.h"

namespace stereobench::renderer {

/// Owns the programs of the materials in use, the meshes and the stream of polygons.
class SurfacePainter {
 public:
  /// @param surfaces of the world
  SurfacePainter(const Gl& gl, const worlds::World& world, const Surfaces& surfaces);

  /// Draws the surfaces that the camera can see over an empty picture; their identity is 0.
  void draw(const CameraView& view);

  /// The same with the numbers of primitives (primitives.h) in place of colours.
  void draw_primitives(const CameraView& view);

 private:
  struct PaintProgram {
    Program program;
    GLint clip_from_position;
    GLint tint;
    GLint shape, first, last_level;  // of textures alone
  };
  struct PrimitiveProgram {
    Program program;
    GLint clip_from_position;
    GLint primitive;
  };
  void compile(SurfacePaint paint);
  /// @param texture of kTexture
  void use(SurfacePaint paint, int texture, const Eigen::Vector3f& tint_rgb,
           const glm::mat4& clip_from_position) const;
  const PolygonTexture& texture_of(const SurfacePolygon& polygon) const;
  void use_primitives(int first, int for_each_triangle, const glm::mat4& clip_from_position);
  template <typename UseMesh, typename UsePolygon>
  void draw(const CameraView& view, UseMesh use_mesh, UsePolygon use_polygon);

  const Gl* gl_;
  worlds::World world_;
  std::array<std::optional<PaintProgram>, 8> programs_;  // by SurfacePaint
  std::optional<PrimitiveProgram> primitive_program_;    // once somebody asked
  std::vector<MeshRun> mesh_runs_;
  std::optional<NumberList> texels_;  // where there are textures
  std::vector<MipPlace> textures_;
  std::vector<PolygonTexture> polygon_textures_;  // by primitive
  VertexArray meshes_;
  VertexArray polygons_;
};

}  // namespace stereobench::renderer
