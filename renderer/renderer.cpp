#include "renderer/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "renderer/balls/ball_painter.h"
#include "renderer/camera/lens.h"
#include "renderer/camera/readback.h"
#include "renderer/gl/idle_code.h"
#include "renderer/surfaces/edge_smoother.h"
#include "renderer/surfaces/surface_painter.h"
#include "renderer/surfaces/surface_textures.h"
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
    require(std::isfinite(mesh.roll_rad + mesh.pitch_rad) && mesh.unit_m > 0.0 && std::isfinite(mesh.unit_m),
            "Renderer: a mesh needs a finite tilt and a positive unit");
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

/// State that never changes: see camera_view.h for the depth's convention.
void set_state(const Gl& gl) {
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_SCISSOR_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.CullFace(GL_FRONT);  // where it is enabled: what is counter-clockwise in the world is not in a picture
                          // whose rows point down
  gl.ClearDepth(0.0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

/// Lenses that distort; none where they do not.
std::optional<Lens> lens_of(const vision::StereoRig& rig) {
  return rig.distortion == vision::Distortion{} ? std::nullopt : std::optional<Lens>(rig);
}

cv::Range columns_of(const CameraView& view) {
  return {view.first_column_px, view.first_column_px + view.intrinsics.width_px};
}

/// One camera's picture while it is made.
struct CameraPicture {
  CameraView view;
  RenderedImage frame;
  std::vector<EdgeMix> mixes;
  std::vector<BallOutline> balls;
};

/// The same camera with a picture of some rows alone.
CameraView part_of(CameraView view, const cv::Range& rows) {
  view.intrinsics.cy_px -= rows.start;
  view.intrinsics.height_px = rows.size();
  return view;
}

/// Some rows of a picture that begins with a row of the whole one.
RenderedImage part_of(const RenderedImage& frame, int first_row, const cv::Range& rows) {
  const cv::Range part(rows.start - first_row, rows.end - first_row);
  return {frame.colour.rowRange(part), frame.ball_id.rowRange(part), frame.depth_m.rowRange(part)};
}

}  // namespace

struct Renderer::Parts {
  vision::StereoRig asked_rig;
  std::optional<Lens> lens;
  vision::StereoRig rig;  ///< without distortion
  LightDepth depth;
  Eigen::Vector3f sky_rgb;
  std::unique_ptr<Context> context;
  Gl gl;
  Framebuffer framebuffer;
  SurfacePainter surfaces;
  BallPainter balls;
  EdgeSmoother edges;
  PicturePool pictures;
  PicturePool undistorted_pictures;  ///< those that the lens distorts
  bool has_drawn = false;

  /// @param placed read before there is a context, as reading meshes forks
  Parts(const worlds::World& world, const Surfaces& placed, const vision::StereoRig& asked, Backend backend,
        LightDepth light_depth)
      : asked_rig(checked(asked)),
        lens(lens_of(asked)),
        rig(lens ? lens->pinhole_rig() : asked),
        depth(light_depth),
        sky_rgb(world.sky_rgb.cast<float>()),
        context(make_context(backend)),
        gl(*context),
        framebuffer(gl, depth == LightDepth::kEightBits ? GL_RGBA8 : GL_RGBA16, 2 * rig.intrinsics.width_px,
                    rig.intrinsics.height_px),
        surfaces(gl, world, placed),
        balls(gl, world),
        edges(world, placed.meshes) {
    set_state(gl);
    gl.ReleaseShaderCompiler();  // 5 MB of Mesa's, which the pictures need more
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { context->make_current(); }  // what is deleted next belongs to it

  /// Where the cameras are, with an empty framebuffer of a colour before them.
  std::array<CameraView, 2> open_cameras(const slam::Pose& left_pose, const slam::Pose& right_pose,
                                         const Eigen::Vector3f& rgb, const cv::Range& rows) {
    for (const slam::Pose& pose : {left_pose, right_pose}) {
      require(std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad),
              "Renderer: the pose is not finite");
    }
    context->make_current();
    framebuffer.bind();
    gl.Scissor(0, rows.start, 2 * rig.intrinsics.width_px, rows.size());
    gl.ClearColor(rgb.z(), rgb.y(), rgb.x(), 0.0F);  // the picture's order is blue, green, red, identity
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return {camera_view(rig, vision::Side::kLeft, left_pose),
            camera_view(rig, vision::Side::kRight, right_pose)};
  }

  void look_through(const CameraView& view) {
    gl.Viewport(view.first_column_px, 0, view.intrinsics.width_px, view.intrinsics.height_px);
  }

  /// What compiled the first pair's shaders makes room for its pictures.
  void release_compiler() {
    if (!std::exchange(has_drawn, true)) release_code(kCompiler);
  }

  int height_px() const { return lens ? lens->height_px() : rig.intrinsics.height_px; }

  /// Rows of the picture that is asked for, not of what is drawn.
  cv::Range checked_rows(const cv::Range& asked) const {
    const cv::Range all(0, height_px());
    if (asked == cv::Range::all()) return all;
    require(asked.start >= 0 && asked.start < asked.end && asked.end <= all.end,
            "Renderer::render: the picture has no such rows");
    return asked;
  }

  /// With the rows beside them, whose edges may reach into them.
  cv::Range with_neighbours(const cv::Range& rows) const {
    return {std::max(rows.start - 1, 0), std::min(rows.end + 1, rig.intrinsics.height_px)};
  }

  /// Reads what has been drawn: surfaces, before any ball hides their edges.
  CameraPicture read_surfaces(const CameraView& view, const cv::Range& rows) {
    CameraPicture picture = {.view = view,
                             .frame = blank_frame({view.intrinsics.width_px, rows.size()}, depth,
                                                  lens ? undistorted_pictures : pictures)};
    read_part(gl, {view.first_column_px, rows.start}, {{0, 0}, picture.frame.colour.size()}, picture.frame);
    picture.mixes = edges.mixes(part_of(view, rows), picture.frame);
    picture.balls = balls.outlines(view);
    return picture;
  }

  void draw_balls(const CameraPicture& picture) {
    look_through(picture.view);
    balls.draw(picture.view, picture.balls);
  }

  /// Reads the balls that have been drawn, and smooths what is behind and before them.
  void finish(CameraPicture& picture, const cv::Range& rows) const {
    const BallVeil veil(picture.view, picture.balls, rows);
    for (const cv::Rect& box : veil.boxes())
      read_part(gl, {picture.view.first_column_px, rows.start}, box, picture.frame);
    mix_edges(picture.mixes, veil, picture.frame);
  }
};

Renderer::Renderer(const worlds::World& world, const vision::StereoRig& rig, Backend backend,
                   LightDepth depth, const FormReader& read)
    : parts_(std::make_unique<Parts>(world, place_surfaces(checked(world), read), rig, backend, depth)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&& other) noexcept = default;
Renderer& Renderer::operator=(Renderer&& other) noexcept = default;

int Renderer::height_px() const {
  return parts_->height_px();
}

const vision::StereoRig& Renderer::rig() const {
  return parts_->asked_rig;
}

StereoFrame Renderer::render(const slam::Pose& left_pose, const slam::Pose& right_pose,
                             const cv::Range& asked) {
  const cv::Range rows = parts_->checked_rows(asked);
  const cv::Range drawn = parts_->with_neighbours(parts_->lens ? parts_->lens->rows_seen(rows) : rows);
  const auto views = parts_->open_cameras(left_pose, right_pose, parts_->sky_rgb, drawn);
  for (const CameraView& view : views) {
    parts_->look_through(view);
    parts_->surfaces.draw(view);
  }
  std::array<CameraPicture, 2> pictures = {parts_->read_surfaces(views[0], drawn),
                                           parts_->read_surfaces(views[1], drawn)};
  for (const CameraPicture& picture : pictures) parts_->draw_balls(picture);
  parts_->release_compiler();
  const auto finished = [&](CameraPicture& picture) {
    parts_->finish(picture, drawn);
    const std::optional<Lens>& lens = parts_->lens;
    return lens ? lens->distort(picture.frame, drawn.start, rows, parts_->pictures)
                : part_of(picture.frame, drawn.start, rows);
  };
  return {finished(pictures[0]), finished(pictures[1])};
}

StereoIdBuffers Renderer::id_buffers(const slam::Pose& left_pose, const slam::Pose& right_pose,
                                     const cv::Range& asked) {
  require(!parts_->lens || asked == cv::Range::all(),
          "Renderer::id_buffers: behind a lens, of all rows alone");
  const cv::Range rows =
      parts_->lens ? cv::Range(0, parts_->rig.intrinsics.height_px) : parts_->checked_rows(asked);
  const auto [left, right] = parts_->open_cameras(left_pose, right_pose, Eigen::Vector3f::Zero(), rows);
  for (const CameraView& view : {left, right}) {
    parts_->look_through(view);
    parts_->surfaces.draw_primitives(view);
    parts_->balls.draw_primitives(view);
  }
  const auto seen = [&](const CameraView& view) {
    return IdBuffer{part_of(view, rows), read_primitives(parts_->gl, columns_of(view), rows)};
  };
  return {seen(left), seen(right)};
}

}  // namespace stereobench::renderer
