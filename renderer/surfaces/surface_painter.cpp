#include "renderer/surfaces/surface_painter.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include "renderer/surfaces/primitive_shader.h"

namespace stereobench::renderer {
namespace {

constexpr std::array<int, 4> kVertexWidths = {4, 2, 1, 3};
static_assert(sizeof(SurfaceVertex) == kSurfaceVertexFloats * sizeof(float),
              "vertices are streamed as they are");

std::span<const float> floats(const std::vector<SurfaceVertex>& vertices) {
  if (vertices.empty()) return {};
  return {vertices.front().position, vertices.size() * kSurfaceVertexFloats};
}

/// Of walls and the floor, whose files are textures.
SurfacePaint paint_of(worlds::Material material) {
  return material == worlds::Material::kFile ? SurfacePaint::kTexture : static_cast<SurfacePaint>(material);
}

SurfacePaint paint_of(const MeshRun& run) {
  if (run.material != worlds::Material::kFile) return paint_of(run.material);
  if (run.texture >= 0) return SurfacePaint::kTexture;
  return run.has_corner_colours ? SurfacePaint::kCorners : SurfacePaint::kPaint;
}

}  // namespace

SurfacePainter::SurfacePainter(const Gl& gl, const worlds::World& world, const Surfaces& surfaces)
    : gl_(&gl),
      world_(world),
      mesh_runs_(surfaces.meshes.runs),
      polygon_textures_(surfaces.polygons),
      meshes_(gl, kVertexWidths, 0),
      polygons_(gl, kVertexWidths, 0) {
  const MeshSurfaces& meshes = surfaces.meshes;
  if (world.has_floor) compile(paint_of(world.floor));
  for (const worlds::Wall& wall : world.walls) compile(paint_of(wall.material));
  for (const MeshRun& run : meshes.runs) compile(paint_of(run));
  meshes_.upload(floats(meshes.vertices));
  if (meshes.textures.empty()) return;
  MipChains mip_chains = make_mip_chains(meshes.textures);
  texels_.emplace(gl, mip_chains.texels);
  textures_ = std::move(mip_chains.places);
}

void SurfacePainter::compile(SurfacePaint paint) {
  auto& slot = programs_.at(static_cast<std::size_t>(paint));
  if (slot) return;
  Program program(*gl_, surface_vertex_shader(), surface_fragment_shader(paint));
  const GLint matrix = program.uniform("u_clip_from_position");
  const GLint tint = program.uniform("u_tint"), shape = program.uniform("u_shape");
  const GLint first = program.uniform("u_first"), last_level = program.uniform("u_last_level");
  slot.emplace(PaintProgram{std::move(program), matrix, tint, shape, first, last_level});
}

void SurfacePainter::use(SurfacePaint paint, int texture, const Eigen::Vector3f& tint_rgb,
                         const glm::mat4& clip_from_position) const {
  const PaintProgram& chosen = *programs_[static_cast<std::size_t>(paint)];
  chosen.program.use();
  gl_->UniformMatrix4fv(chosen.clip_from_position, 1, GL_FALSE, glm::value_ptr(clip_from_position));
  gl_->Uniform3f(chosen.tint, tint_rgb.x(), tint_rgb.y(), tint_rgb.z());
  if (paint != SurfacePaint::kTexture) return;
  const MipPlace& place = textures_[static_cast<std::size_t>(texture)];
  texels_->bind();
  gl_->Uniform1iv(chosen.shape, 4, place.shape.data());
  gl_->Uniform1iv(chosen.first, kMostLevels, place.first.data());
  gl_->Uniform1iv(chosen.last_level, 1, &place.last_level);
}

const PolygonTexture& SurfacePainter::texture_of(const SurfacePolygon& polygon) const {
  return polygon_textures_[static_cast<std::size_t>(polygon.primitive - kFloorPrimitive)];
}

void SurfacePainter::use_primitives(int first, int for_each_triangle, const glm::mat4& clip_from_position) {
  if (!primitive_program_) {
    Program program(*gl_, surface_vertex_shader(), primitive_fragment_shader());
    const GLint matrix = program.uniform("u_clip_from_position");
    const GLint primitive = program.uniform("u_primitive");
    primitive_program_.emplace(PrimitiveProgram{std::move(program), matrix, primitive});
  }
  primitive_program_->program.use();
  gl_->UniformMatrix4fv(primitive_program_->clip_from_position, 1, GL_FALSE,
                        glm::value_ptr(clip_from_position));
  gl_->Uniform2i(primitive_program_->primitive, first, for_each_triangle);
}

/// Draws meshes, then polygons. What each is painted with is for the callers to say; corners of polygons are
/// in clip space already.
template <typename UseMesh, typename UsePolygon>
void SurfacePainter::draw(const CameraView& view, UseMesh use_mesh, UsePolygon use_polygon) {
  meshes_.bind();
  for (const MeshRun& run : mesh_runs_) {
    if (!can_see(view, run)) continue;
    use_mesh(run);
    if (run.one_sided) gl_->Enable(GL_CULL_FACE);
    gl_->DrawArrays(GL_TRIANGLES, run.first, run.count);
    gl_->Disable(GL_CULL_FACE);
  }
  const std::vector<SurfacePolygon> polygons = visible_polygons(view, world_);
  std::vector<SurfaceVertex> vertices;
  for (const SurfacePolygon& polygon : polygons) {
    const PolygonTexture& texture = texture_of(polygon);
    for (SurfaceVertex corner : polygon.corners) {
      if (texture.index >= 0)
        std::ranges::copy(texture.texel(corner.along_m, polygon.runs_left), corner.along_m);
      vertices.push_back(corner);
    }
  }
  polygons_.bind();
  polygons_.upload(floats(vertices));
  GLint first = 0;
  for (const SurfacePolygon& polygon : polygons) {
    use_polygon(polygon);
    const auto count = static_cast<GLsizei>(polygon.corners.size());
    gl_->DrawArrays(GL_TRIANGLE_FAN, first, count);
    first += count;
  }
}

void SurfacePainter::draw(const CameraView& view) {
  draw(
      view,
      [this, matrix = clip_from_world(view)](const MeshRun& run) {
        use(paint_of(run), run.texture, run.tint_rgb, matrix);
      },
      [this](const SurfacePolygon& polygon) {
        use(paint_of(polygon.material), texture_of(polygon).index, polygon.tint_rgb, glm::mat4(1.0F));
      });
}

void SurfacePainter::draw_primitives(const CameraView& view) {
  const int meshes = first_mesh_primitive(world_);
  draw(
      view,
      [&, matrix = clip_from_world(view)](const MeshRun& run) {
        use_primitives(meshes + run.first / 3, 1, matrix);
      },
      [&](const SurfacePolygon& polygon) { use_primitives(polygon.primitive, 0, glm::mat4(1.0F)); });
}

}  // namespace stereobench::renderer
