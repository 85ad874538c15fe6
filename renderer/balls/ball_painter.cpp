#include "renderer/balls/ball_painter.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace stereobench::renderer {
namespace {

constexpr std::array<int, 6> kOutlineWidths = {4, 4, 4, 4, 4, 4};
static_assert(sizeof(BallOutline) == 24 * sizeof(float), "outlines are streamed to the shader as they are");

/// Indices of the balls, the farthest from the camera first.
std::vector<std::size_t> far_to_near(const CameraView& view, const std::vector<worlds::Ball>& balls) {
  const Eigen::Vector3d camera_m = view.centre_in_world();
  const auto nearest = [&](std::size_t index) {
    return (balls[index].centre_m - camera_m).norm() - balls[index].radius_m;
  };
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return nearest(a) > nearest(b); });
  return order;
}

bool overlap(const BallOutline& a, const BallOutline& b) {
  return a.bounds[0] < b.bounds[2] && b.bounds[0] < a.bounds[2] && a.bounds[1] < b.bounds[3] &&
         b.bounds[1] < a.bounds[3];
}

/// Balls that have no pixel in common may be drawn in any order, and thus at once.
/// @param outlines the farthest first
/// @return layers of such balls; each ball is in a later one than those behind it
std::vector<std::vector<BallOutline>> layers_of(const std::vector<BallOutline>& outlines) {
  std::vector<std::vector<BallOutline>> layers;
  for (const BallOutline& outline : outlines) {
    const auto is_behind = [&](const BallOutline& other) { return overlap(other, outline); };
    const auto last_behind = std::find_if(layers.rbegin(), layers.rend(), [&](const auto& layer) {
      return std::ranges::any_of(layer, is_behind);
    });
    const auto place = static_cast<std::size_t>(layers.rend() - last_behind);
    if (place == layers.size()) layers.emplace_back();
    layers[place].push_back(outline);
  }
  return layers;
}

}  // namespace

BallPainter::BallPainter(const Gl& gl, const worlds::World& world)
    : gl_(&gl),
      balls_(world.balls),
      light_(world.light),
      stream_(gl, kOutlineWidths, 1),
      core_(make_part(gl, BallPart::kCore)),
      rim_(make_part(gl, BallPart::kRim)) {}

BallPainter::Part BallPainter::make_part(const Gl& gl, BallPart which) const {
  Program program(gl, ball_vertex_shader(), ball_fragment_shader(which));
  program.use();
  gl.Uniform2f(program.uniform("u_light"), static_cast<float>(light_.ambient),
               static_cast<float>(light_.diffuse));
  gl.Uniform1f(program.uniform("u_near"), static_cast<float>(kNear_m));
  const GLint towards_light = program.uniform("u_towards_light");
  return {std::move(program), towards_light};
}

void BallPainter::prepare(const Part& part, const CameraView& view) const {
  const Eigen::Vector3f towards =
      (view.camera_from_world.linear() * light_.towards_light.normalized()).cast<float>();
  part.program.use();
  gl_->Uniform3f(part.towards_light, towards.x(), towards.y(), towards.z());
}

void BallPainter::upload(const std::vector<BallOutline>& outlines) {
  stream_.upload({outlines.front().centre.data(), outlines.size() * 24});
}

void BallPainter::draw_boxes(std::size_t count) const {
  gl_->DrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count), 0);
}

std::vector<BallOutline> BallPainter::outlines(const CameraView& view) const {
  std::vector<BallOutline> seen;
  for (const std::size_t index : far_to_near(view, balls_)) {
    const auto outline = ball_outline(view, balls_[index], static_cast<int>(index) + 1);
    if (outline) seen.push_back(*outline);
  }
  return seen;
}

void BallPainter::draw(const CameraView& view, const std::vector<BallOutline>& outlines) {
  if (outlines.empty()) return;
  prepare(core_, view);
  prepare(rim_, view);
  stream_.bind();
  gl_->Enable(GL_BLEND);
  for (const std::vector<BallOutline>& layer : layers_of(outlines)) {
    upload(layer);
    core_.program.use();
    gl_->DepthMask(GL_TRUE);
    gl_->BlendFuncSeparate(GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR, GL_ONE, GL_ZERO);
    draw_boxes(layer.size());
    rim_.program.use();
    gl_->DepthMask(GL_FALSE);
    gl_->BlendFuncSeparate(GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR, GL_ZERO, GL_ONE);
    draw_boxes(layer.size());
  }
  gl_->DepthMask(GL_TRUE);
  gl_->Disable(GL_BLEND);
}

void BallPainter::draw_primitives(const CameraView& view) {
  const std::vector<BallOutline> outlines = this->outlines(view);
  if (outlines.empty()) return;
  if (!primitive_) primitive_.emplace(make_part(*gl_, BallPart::kPrimitive));
  primitive_->program.use();
  stream_.bind();
  upload(outlines);
  draw_boxes(outlines.size());
}

}  // namespace stereobench::renderer
