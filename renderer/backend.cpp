#include "renderer/backend.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "renderer/gl/gl.h"
#include "renderer/renderer.h"
#include "vision/palette.h"
#include "vision/stereo/sphere.h"

namespace stereobench::renderer {
namespace {

constexpr double kBallAhead_m = 1.5;

worlds::World test_world() {
  using worlds::Material;
  worlds::World world;
  world.balls.push_back({.centre_m = {kBallAhead_m, 0.0, 0.3}, .radius_m = 0.1, .colour = 0});
  world.walls = {{.from_m = {3.0, 1.2}, .to_m = {3.0, -1.2}, .material = Material::kBricks},
                 {.from_m = {0.0, 1.2}, .to_m = {3.0, 1.2}, .material = Material::kPlaster},
                 {.from_m = {0.0, -1.2}, .to_m = {3.0, -1.2}, .material = Material::kWood},
                 {.from_m = {2.6, 0.9}, .to_m = {2.6, -0.3}, .height_m = 0.2, .material = Material::kPlain}};
  world.light = {.towards_light = {-1.0, 0.0, 0.0}, .ambient = 0.5, .diffuse = 0.5};
  return world;
}

vision::StereoRig test_rig() {
  return {.intrinsics = {.width_px = 160, .height_px = 120, .focal_px = 150.0, .cx_px = 79.5, .cy_px = 59.5},
          .baseline_m = 0.12,
          .height_m = 0.3};
}

std::string image_complaint(const RenderedImage& frame, const vision::StereoRig& rig, vision::Side side) {
  const worlds::Ball ball = test_world().balls.front();
  const double side_m = (side == vision::Side::kLeft ? 0.5 : -0.5) * rig.baseline_m;
  const auto outline = vision::sphere_outline(rig.intrinsics, {side_m, 0.0, kBallAhead_m}, ball.radius_m);
  const cv::Point centre(static_cast<int>(std::lround(outline->centre_px.x())),
                         static_cast<int>(std::lround(outline->centre_px.y())));
  if (frame.ball_id.at<std::uint8_t>(centre) != 1) return "the ball is not where it should be";
  const double expected_px2 = M_PI * outline->semi_major_px * outline->semi_minor_px;
  const int seen_px = cv::countNonZero(frame.ball_id);
  if (!(std::abs(seen_px - expected_px2) < 0.02 * expected_px2)) {
    return fmt::format("the ball covers {} pixels, not {:.0f}", seen_px, expected_px2);
  }
  const double depth_m = double{frame.depth_m.at<float>(centre)};
  if (!(std::abs(depth_m - (kBallAhead_m - ball.radius_m)) < 1e-3)) {
    return fmt::format("the ball is {:.4f} m away, not {:.4f}", depth_m, kBallAhead_m - ball.radius_m);
  }
  const int red = frame.colour.at<cv::Vec3b>(centre)[2];
  if (std::abs(red - vision::kPalette[0].r) > 2) return fmt::format("the ball's red is {}, not 229", red);
  return {};
}

std::string frame_complaint(const StereoFrame& frame, const vision::StereoRig& rig) {
  const std::string left = image_complaint(frame.left, rig, vision::Side::kLeft);
  if (!left.empty()) return "left camera: " + left;
  const std::string right = image_complaint(frame.right, rig, vision::Side::kRight);
  return right.empty() ? std::string() : "right camera: " + right;
}

/// FNV-1a, 64 bits: the same wherever it is computed, unlike std::hash.
/// (G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, The FNV Non-Cryptographic Hash Algorithm.)
std::uint64_t hash_of(const StereoFrame& frame) {
  std::uint64_t hash = 14695981039346656037U;
  for (const RenderedImage* image : {&frame.left, &frame.right}) {
    for (const cv::Mat& picture : {image->colour, image->ball_id, image->depth_m}) {
      for (const std::uint8_t* byte = picture.datastart; byte != picture.dataend; ++byte) {
        hash = (hash ^ *byte) * 1099511628211U;
      }
    }
  }
  return hash;
}

}  // namespace

const char* name_of(Backend backend) {
  constexpr std::array<const char*, kBackends.size()> kNames = {"osmesa", "egl", "egl-gpu"};
  return kNames.at(static_cast<std::size_t>(drawn_by(backend)));
}

Backend backend_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Backend backend : kBackends) {
    if (name == name_of(backend)) return backend;
    names.emplace_back(name_of(backend));
  }
  throw std::runtime_error(
      fmt::format("no back end is called '{}'; there are {}", name, fmt::join(names, ", ")));
}

BackendInfo backend_info(Backend backend) {
  const auto context = make_context(backend);
  const Gl gl(*context);
  return {gl_string(gl, GL_VERSION), gl_string(gl, GL_RENDERER), gl_string(gl, GL_VENDOR)};
}

TestFrame render_test_frame(Backend backend) {
  const vision::StereoRig rig = test_rig();
  const StereoFrame frame = Renderer(test_world(), rig, backend).render({});
  return {frame_complaint(frame, rig), hash_of(frame)};
}

std::string fingerprint(const BackendInfo& info, const TestFrame& frame) {
  return fmt::format("{}, {}, frame {:016x}", info.gl_version, info.gl_renderer, frame.hash);
}

}  // namespace stereobench::renderer
