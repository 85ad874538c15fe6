#include "renderer/surface_painter.h"

#include <glm/gtc/type_ptr.hpp>

#include "renderer/material_shader.h"

namespace stereobench::renderer {
namespace {

constexpr std::array<int, 3> kVertexWidths = {4, 2, 1};
static_assert(sizeof(SurfaceVertex) == kSurfaceVertexFloats * sizeof(float),
              "vertices are streamed as they are");

std::span<const float> floats(const std::vector<SurfaceVertex>& vertices) {
  if (vertices.empty()) return {};
  return {vertices.front().position, vertices.size() * kSurfaceVertexFloats};
}

}  // namespace

SurfacePainter::SurfacePainter(const Gl& gl, const worlds::World& world, const MeshSurfaces& placed)
    : gl_(&gl),
      world_(world),
      mesh_runs_(placed.runs),
      meshes_(gl, kVertexWidths, 0),
      polygons_(gl, kVertexWidths, 0) {
  compile(world.floor);
  for (const worlds::Wall& wall : world.walls) compile(wall.material);
  for (const worlds::MeshInstance& mesh : world.meshes) compile(mesh.material);
  meshes_.upload(floats(placed.vertices));
}

void SurfacePainter::compile(worlds::Material material) {
  auto& slot = programs_.at(static_cast<std::size_t>(material));
  if (slot) return;
  Program program(*gl_, surface_vertex_shader(), surface_fragment_shader(material));
  const GLint matrix = program.uniform("u_clip_from_position");
  const GLint colour = program.uniform("u_colour");
  slot.emplace(MaterialProgram{std::move(program), matrix, colour});
}

const SurfacePainter::MaterialProgram& SurfacePainter::use(worlds::Material material,
                                                           const glm::mat4& clip_from_position) const {
  const MaterialProgram& chosen = *programs_[static_cast<std::size_t>(material)];
  chosen.program.use();
  gl_->UniformMatrix4fv(chosen.clip_from_position, 1, GL_FALSE, glm::value_ptr(clip_from_position));
  return chosen;
}

void SurfacePainter::draw(const EyeView& view) {
  draw_meshes(view);
  draw_polygons(view);
}

void SurfacePainter::draw_meshes(const EyeView& view) const {
  const glm::mat4 matrix = clip_from_world(view);
  meshes_.bind();
  for (const MeshRun& run : mesh_runs_) {
    if (!can_see(view, run)) continue;
    const MaterialProgram& chosen = use(run.material, matrix);
    gl_->Uniform3f(chosen.colour, run.colour_rgb.x(), run.colour_rgb.y(), run.colour_rgb.z());
    if (run.one_sided) gl_->Enable(GL_CULL_FACE);
    gl_->DrawArrays(GL_TRIANGLES, run.first, run.count);
    gl_->Disable(GL_CULL_FACE);
  }
}

void SurfacePainter::draw_polygons(const EyeView& view) {
  const std::vector<SurfacePolygon> polygons = visible_polygons(view, world_);
  std::vector<SurfaceVertex> vertices;
  for (const SurfacePolygon& polygon : polygons) {
    vertices.insert(vertices.end(), polygon.corners.begin(), polygon.corners.end());
  }
  polygons_.bind();
  polygons_.upload(floats(vertices));
  GLint first = 0;
  for (const SurfacePolygon& polygon : polygons) {
    use(polygon.material, glm::mat4(1.0F));  // the corners are in clip space already
    const auto count = static_cast<GLsizei>(polygon.corners.size());
    gl_->DrawArrays(GL_TRIANGLE_FAN, first, count);
    first += count;
  }
}

}  // namespace stereobench::renderer
