#include "renderer/surface_painter.h"

#include <glm/gtc/type_ptr.hpp>

#include "renderer/facet_shader.h"
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

SurfacePainter::SurfacePainter(const Gl& gl, const worlds::World& world, const MeshSurfaces& meshes)
    : gl_(&gl),
      world_(world),
      mesh_runs_(meshes.runs),
      meshes_(gl, kVertexWidths, 0),
      polygons_(gl, kVertexWidths, 0) {
  compile(world.floor);
  for (const worlds::Wall& wall : world.walls) compile(wall.material);
  for (const worlds::MeshInstance& mesh : world.meshes) compile(mesh.material);
  meshes_.upload(floats(meshes.vertices));
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

void SurfacePainter::use_facets(int first, int for_each_triangle, const glm::mat4& clip_from_position) {
  if (!facet_program_) {
    Program program(*gl_, surface_vertex_shader(), facet_fragment_shader());
    const GLint matrix = program.uniform("u_clip_from_position");
    const GLint facet = program.uniform("u_facet");
    facet_program_.emplace(FacetProgram{std::move(program), matrix, facet});
  }
  facet_program_->program.use();
  gl_->UniformMatrix4fv(facet_program_->clip_from_position, 1, GL_FALSE, glm::value_ptr(clip_from_position));
  gl_->Uniform2i(facet_program_->facet, first, for_each_triangle);
}

/// Draws meshes, then polygons. What each is painted with is for the callers to say; corners of polygons are
/// in clip space already.
template <typename UseMesh, typename UsePolygon>
void SurfacePainter::draw(const EyeView& view, UseMesh use_mesh, UsePolygon use_polygon) {
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
    vertices.insert(vertices.end(), polygon.corners.begin(), polygon.corners.end());
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

void SurfacePainter::draw(const EyeView& view) {
  draw(
      view,
      [this, matrix = clip_from_world(view)](const MeshRun& run) {
        const MaterialProgram& chosen = use(run.material, matrix);
        gl_->Uniform3f(chosen.colour, run.colour_rgb.x(), run.colour_rgb.y(), run.colour_rgb.z());
      },
      [this](const SurfacePolygon& polygon) { use(polygon.material, glm::mat4(1.0F)); });
}

void SurfacePainter::draw_facets(const EyeView& view) {
  const int meshes = first_mesh_facet(world_);
  draw(
      view,
      [&, matrix = clip_from_world(view)](const MeshRun& run) {
        use_facets(meshes + run.first / 3, 1, matrix);
      },
      [&](const SurfacePolygon& polygon) { use_facets(polygon.facet, 0, glm::mat4(1.0F)); });
}

}  // namespace stereobench::renderer
