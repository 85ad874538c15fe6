/// Rendering beside the limit: a caster of rays that was written for one room. In a line of its own, as a
/// ratio.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "renderer/balls/ball_outline.h"
#include "renderer/surfaces/edge_smoother.h"
#include "renderer/surfaces/surface_polygons.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/ray_cast_limit.h"

namespace stereobench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// One camera of the scene, in the caster's terms.
struct LimitScene {
  std::vector<LimitSurface> surfaces;
  std::vector<LimitBall> balls;
  LimitLight light;
};

/// n . ray of a pixel, n in the camera frame.
Linear along_rays(const vision::Intrinsics& camera, const Vector3d& n) {
  const Vector2d slope = n.head<2>() / camera.focal_px;
  const double at_zero = n.z() - slope.dot(Vector2d(camera.cx_px, camera.cy_px));
  return {static_cast<float>(at_zero), static_cast<float>(slope.x()), static_cast<float>(slope.y())};
}

/// A plane's point, its unit axes and how far it goes along them.
struct Plane {
  Vector3d corner, along, up;
  Eigen::AlignedBox2d reach_m;
};

Plane plane_of(const worlds::World& world, int primitive) {
  constexpr double kReach_m = 1e4;
  if (primitive == renderer::kFloorPrimitive)
    return {Vector3d::Zero(),
            Vector3d::UnitX(),
            Vector3d::UnitY(),
            {Vector2d::Constant(-kReach_m), Vector2d::Constant(kReach_m)}};
  const worlds::Wall& wall = world.walls[static_cast<std::size_t>(primitive - renderer::kFirstWallPrimitive)];
  const Vector2d run = wall.to_m - wall.from_m;
  return {{wall.from_m.x(), wall.from_m.y(), 0.0},
          Vector3d(run.x(), run.y(), 0.0).normalized(),
          Vector3d::UnitZ(),
          {Vector2d::Zero(), Vector2d(run.norm(), wall.height_m)}};
}

/// @param low, high of places in clip space over w, [-1, 1]
void set_bounds(const vision::Intrinsics& camera, const Vector2d& low, const Vector2d& high,
                int (&columns)[2], int (&rows)[2]) {
  const Vector2d size(camera.width_px, camera.height_px);
  const Vector2d first = (0.5 * (low.array() + 1.0) * size.array()).floor();
  const Vector2d end = (0.5 * (high.array() + 1.0) * size.array()).ceil();
  columns[0] = static_cast<int>(first.x()), columns[1] = static_cast<int>(end.x());
  rows[0] = static_cast<int>(first.y()), rows[1] = static_cast<int>(end.y());
}

LimitSurface surface_of(const renderer::CameraView& view, const worlds::World& world,
                        const renderer::SurfacePolygon& polygon) {
  const bool is_floor = polygon.primitive == renderer::kFloorPrimitive;
  if (polygon.material != (is_floor ? worlds::Material::kTiles : worlds::Material::kBricks))
    throw std::invalid_argument("the limit is that of a room of tiles and bricks");
  const Plane plane = plane_of(world, polygon.primitive);
  const Eigen::Matrix3d turn = view.camera_from_world.linear();
  const Vector3d to_corner = plane.corner - view.centre_in_world();
  const Vector3d normal = plane.along.cross(plane.up);
  const Vector3d n = normal / normal.dot(to_corner);
  LimitSurface surface;
  surface.inverse_depth = along_rays(view.intrinsics, turn * n);
  surface.along = along_rays(view.intrinsics, turn * (plane.along - plane.along.dot(to_corner) * n));
  surface.up = along_rays(view.intrinsics, turn * (plane.up - plane.up.dot(to_corner) * n));
  const auto narrow = [](double value) { return static_cast<float>(value); };
  for (int end = 0; end < 2; ++end) {
    const Vector2d reach = end == 0 ? plane.reach_m.min() : plane.reach_m.max();
    surface.along_m[end] = narrow(reach.x());
    surface.up_m[end] = narrow(reach.y());
  }
  surface.light = polygon.corners.front().light;
  surface.is_floor = is_floor;
  Eigen::AlignedBox2d box;
  for (const renderer::SurfaceVertex& corner : polygon.corners)
    box.extend(Vector2d(double{corner.position[0]}, double{corner.position[1]}) / double{corner.position[3]});
  set_bounds(view.intrinsics, box.min(), box.max(), surface.columns_px, surface.rows_px);
  return surface;
}

LimitBall ball_of(const renderer::CameraView& view, const renderer::BallOutline& outline) {
  LimitBall ball;
  ball.centre_px[0] = outline.centre[0] - 0.5F + outline.centre[2] - static_cast<float>(view.first_column_px);
  ball.centre_px[1] = outline.centre[1] - 0.5F + outline.centre[3];
  std::copy_n(outline.shape.begin(), 4, ball.shape);
  std::copy_n(outline.ray.begin(), 4, ball.ray);
  std::copy_n(outline.ball.begin(), 4, ball.ball);
  std::copy_n(outline.colour.begin(), 3, ball.rgb);
  ball.id = std::round(255.0F * outline.colour[3]);
  const auto& bounds = outline.bounds;
  set_bounds(view.intrinsics, {double{bounds[0]}, double{bounds[1]}}, {double{bounds[2]}, double{bounds[3]}},
             ball.columns_px, ball.rows_px);
  return ball;
}

LimitScene limit_scene(const renderer::CameraView& view, const worlds::World& world) {
  LimitScene scene;
  for (const renderer::SurfacePolygon& polygon : renderer::visible_polygons(view, world))
    scene.surfaces.push_back(surface_of(view, world, polygon));
  const Vector3d camera_m = view.centre_in_world();
  std::vector<std::pair<double, renderer::BallOutline>> outlines;
  for (std::size_t i = 0; i < world.balls.size(); ++i)
    if (const auto outline = renderer::ball_outline(view, world.balls[i], static_cast<int>(i) + 1))
      outlines.emplace_back((world.balls[i].centre_m - camera_m).norm(), *outline);
  std::sort(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [distance_m, outline] : outlines) scene.balls.push_back(ball_of(view, outline));
  const Eigen::Vector3f towards =
      (view.camera_from_world.linear() * world.light.towards_light.normalized()).cast<float>();
  std::copy_n(towards.data(), 3, scene.light.towards);
  scene.light.ambient = static_cast<float>(world.light.ambient);
  scene.light.diffuse = static_cast<float>(world.light.diffuse);
  for (int i = 0; i < 3; ++i)
    scene.light.sky_bgr[i] = cv::saturate_cast<std::uint8_t>(255.0 * world.sky_rgb[2 - i]);
  return scene;
}

/// Casts the same pair that a renderer draws, edges and all.
class Limit {
 public:
  explicit Limit(const Scene& scene)
      : scene_(scene),
        smoother_(scene.world, {}),
        left_(empty_frame(scene.rig)),
        right_(empty_frame(scene.rig)) {}

  void cast() {
    cast(vision::Side::kLeft, left_);
    cast(vision::Side::kRight, right_);
  }

  const renderer::RenderedImage& left() const { return left_; }

 private:
  static renderer::RenderedImage empty_frame(const vision::StereoRig& rig) {
    const cv::Size size(rig.intrinsics.width_px, rig.intrinsics.height_px);
    return {cv::Mat(size, CV_8UC3), cv::Mat(size, CV_8UC1), cv::Mat(size, CV_32FC1)};
  }

  void cast(vision::Side which, renderer::RenderedImage& frame) {
    renderer::CameraView view = renderer::camera_view(scene_.rig, which, scene_.pose);
    const LimitScene scene = limit_scene(view, scene_.world);
    cast_rays(scene.surfaces, scene.balls, scene.light,
              {frame.colour.cols, frame.colour.rows, frame.colour.data, frame.ball_id.data,
               frame.depth_m.ptr<float>()});
    renderer::mix_edges(smoother_.mixes(view, frame), {}, frame);
  }

  Scene scene_;
  renderer::EdgeSmoother smoother_;
  renderer::RenderedImage left_, right_;
};

/// The share of pixels that two pictures do not agree on, within a level.
double disagreement(const renderer::RenderedImage& a, const renderer::RenderedImage& b) {
  cv::Mat apart;
  cv::absdiff(a.colour, b.colour, apart);
  cv::Mat channels[3];
  cv::split(apart, channels);
  const cv::Mat differ = cv::max(cv::max(channels[0], channels[1]), channels[2]) > 1;
  return static_cast<double>(cv::countNonZero(differ | (a.ball_id != b.ball_id))) /
         static_cast<double>(differ.total());
}

/// The caster's time, and how many times as long the renderer takes: in turns, so that both see the same
/// machine.
void render_pair_limit(benchmark::State& state) {
  if (!can_cast_rays()) return state.SkipWithError("it is written for AVX2");
  Bench bench(eighteen_balls());
  Limit limit(bench.scene);
  double render_s = 0.0, cast_s = 0.0;
  for (auto _ : state) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    benchmark::DoNotOptimize(bench.renderer.render(bench.scene.pose));
    const auto middle = Clock::now();
    limit.cast();
    benchmark::ClobberMemory();
    const double this_s = std::chrono::duration<double>(Clock::now() - middle).count();
    render_s += std::chrono::duration<double>(middle - begin).count();
    cast_s += this_s;
    state.SetIterationTime(this_s);
  }
  state.counters["ratio"] = render_s / cast_s;
  state.counters["other_ppm"] = 1e6 * disagreement(limit.left(), bench.frame.left);
  if (disagreement(limit.left(), bench.frame.left) > 0.01) state.SkipWithError("it casts another picture");
}

BENCHMARK(render_pair_limit)
    ->Name("render_pair/eighteen_balls_limit")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace stereobench
