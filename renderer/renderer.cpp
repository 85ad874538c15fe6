#include "renderer/renderer.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "renderer/ball_painter.h"
#include "renderer/edge_smoother.h"
#include "renderer/readback.h"
#include "renderer/surface_painter.h"
#include "vision/palette.h"

namespace stereobench::renderer {
namespace {

constexpr std::size_t kMostBalls = 254;

void require(bool condition, const char* complaint) {
  if (!condition) throw std::invalid_argument(complaint);
}

const worlds::World& checked(const worlds::World& world) {
  require(world.balls.size() <= kMostBalls, "Renderer: identities are 8 bits: at most 254 balls");
  for (const worlds::Ball& ball : world.balls) {
    require(ball.centre_m.allFinite() && std::isfinite(ball.radius_m) && ball.radius_m > 0.0,
            "Renderer: a ball needs a finite centre and a positive radius");
    require(ball.colour >= 0 && ball.colour < static_cast<int>(vision::kPalette.size()),
            "Renderer: a ball's colour is an index into the palette");
  }
  for (const worlds::Wall& wall : world.walls) {
    require(wall.from_m.allFinite() && wall.to_m.allFinite() && wall.height_m > 0.0,
            "Renderer: a wall is not finite");
  }
  for (const worlds::MeshInstance& mesh : world.meshes) {
    require(
        mesh.position_m.allFinite() && std::isfinite(mesh.heading_rad) && (mesh.scale.array() > 0.0).all(),
        "Renderer: a mesh needs a finite place and a positive scale");
  }
  require(world.light.towards_light.allFinite() && world.light.towards_light.norm() > 0.0,
          "Renderer: the light comes from nowhere");
  return world;
}

const vision::StereoRig& checked(const vision::StereoRig& rig) {
  require(vision::is_usable(rig),
          "Renderer: the rig needs finite numbers, a focal length, a baseline and a size");
  return rig;
}

/// State that never changes: see eye_view.h for the depth's convention.
void set_state(const Gl& gl) {
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClearDepth(0.0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

}  // namespace

struct Renderer::Parts {
  vision::StereoRig rig;
  Eigen::Vector3f sky_rgb;
  std::unique_ptr<Context> context;
  Gl gl;
  Framebuffer framebuffer;
  SurfacePainter surfaces;
  BallPainter balls;
  EdgeSmoother edges;

  Parts(const worlds::World& world, const MeshSurfaces& meshes, const vision::StereoRig& asked,
        Backend backend)
      : rig(checked(asked)),
        sky_rgb(world.sky_rgb.cast<float>()),
        context(make_context(backend)),
        gl(*context),
        framebuffer(gl, 2 * rig.camera.width_px, rig.camera.height_px),
        surfaces(gl, world, meshes),
        balls(gl, world),
        edges(world, meshes) {
    set_state(gl);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { context->make_current(); }  // what is deleted next belongs to it

  /// Where the eyes are, with an empty framebuffer of a colour before them.
  std::array<EyeView, 2> open_eyes(const slam::Pose& left_pose, const slam::Pose& right_pose,
                                   const Eigen::Vector3f& rgb) {
    for (const slam::Pose& pose : {left_pose, right_pose}) {
      require(std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad),
              "Renderer: the pose is not finite");
    }
    context->make_current();
    framebuffer.bind();
    gl.ClearColor(rgb.z(), rgb.y(), rgb.x(), 0.0F);  // the picture's order is blue, green, red, identity
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return {eye_view(rig, vision::Eye::kLeft, left_pose), eye_view(rig, vision::Eye::kRight, right_pose)};
  }

  void look_through(const EyeView& view) {
    gl.Viewport(view.first_column_px, 0, view.camera.width_px, view.camera.height_px);
  }

  cv::Size size_px() const { return {rig.camera.width_px, rig.camera.height_px}; }
};

Renderer::Renderer(const worlds::World& world, const vision::StereoRig& rig, Backend backend)
    : parts_(std::make_unique<Parts>(world, place_meshes(checked(world)), rig, backend)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&& other) noexcept = default;
Renderer& Renderer::operator=(Renderer&& other) noexcept = default;

StereoFrame Renderer::render(const slam::Pose& left_pose, const slam::Pose& right_pose) {
  const auto [left, right] = parts_->open_eyes(left_pose, right_pose, parts_->sky_rgb);
  for (const EyeView& view : {left, right}) {
    parts_->look_through(view);
    parts_->surfaces.draw(view);
    parts_->balls.draw(view);
  }
  StereoFrame frame{read_eye(parts_->gl, left.first_column_px, parts_->size_px()),
                    read_eye(parts_->gl, right.first_column_px, parts_->size_px())};
  parts_->edges.smooth(left, frame.left);
  parts_->edges.smooth(right, frame.right);
  return frame;
}

StereoSight Renderer::sight(const slam::Pose& left_pose, const slam::Pose& right_pose) {
  const auto [left, right] = parts_->open_eyes(left_pose, right_pose, Eigen::Vector3f::Zero());
  for (const EyeView& view : {left, right}) {
    parts_->look_through(view);
    parts_->surfaces.draw_facets(view);
    parts_->balls.draw_facets(view);
  }
  return {{left, read_facets(parts_->gl, left.first_column_px, parts_->size_px())},
          {right, read_facets(parts_->gl, right.first_column_px, parts_->size_px())}};
}

}  // namespace stereobench::renderer
