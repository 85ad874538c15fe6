#include "tests/vision/painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "vision/palette.h"

namespace stereobench::vision::painter {
namespace {

constexpr int kSamples = 16;  // a side, in pixels that an edge crosses
constexpr double kAmbient = 0.45;
constexpr double kDiffuse = 0.55;
constexpr int kNothing = -1;

struct Hit {
  double depth_m = std::numeric_limits<double>::infinity();
  int ball = kNothing;
  int panel = kNothing;
  bool operator==(const Hit& other) const { return ball == other.ball && panel == other.panel; }
};

double tiles(double x, double y) {
  const double tile =
      (static_cast<long>(std::floor(x)) + static_cast<long>(std::floor(y))) % 2 == 0 ? 0.0 : 22.0;
  return 120.0 + tile + 18.0 * std::sin(3.1 * x + 1.7 * y) + 12.0 * std::sin(11.0 * x - 7.0 * y);
}

class CameraPainter {
 public:
  CameraPainter(const Scene& scene, const StereoRig& rig, double shift_m)
      : scene_(scene), camera_(rig.intrinsics), shift_m_(shift_m) {}

  /// The light that each pixel gathers, CV_64FC3.
  cv::Mat light() {
    cv::Mat light(camera_.height_px, camera_.width_px, CV_64FC3);
    for (int y = 0; y < camera_.height_px; ++y) {
      choose_row(y);
      auto* row = light.ptr<cv::Vec3d>(y);
      for (int x = 0; x < camera_.width_px; ++x) {
        const Eigen::Vector3d bgr = pixel(x, y);
        row[x] = {bgr.x(), bgr.y(), bgr.z()};
      }
    }
    return light;
  }

  // Share of a ball's whole outline that this camera sees, counted on a grid of 64 x 64 points of the
  // outline's box.
  double visible(std::size_t ball) const {
    const Eigen::Vector3d centre = in_camera(ball);
    const double reach_x = 1.5 * camera_.focal_px * scene_.balls[ball].radius_m / centre.z();
    const Eigen::Vector2d middle(camera_.cx_px + camera_.focal_px * centre.x() / centre.z(),
                                 camera_.cy_px + camera_.focal_px * centre.y() / centre.z());
    long total = 0;
    long seen = 0;
    for (int j = -63; j <= 63; j += 2) {
      for (int i = -63; i <= 63; i += 2) {
        const Eigen::Vector2d p = middle + Eigen::Vector2d(i, j) * (reach_x / 64.0);
        if (!std::isfinite(ball_depth(ball, ray(p)))) continue;
        ++total;
        if (is_inside(p) && trace_all(p).ball == static_cast<int>(ball)) ++seen;
      }
    }
    return static_cast<double>(seen) / static_cast<double>(total);
  }

  // Directions around the ball's centre in which its rim is seen, and nothing else just outside of it.
  double arc_deg(std::size_t ball) const {
    const Eigen::Vector3d centre = in_camera(ball);
    const Eigen::Vector3d across = centre.cross(Eigen::Vector3d::UnitY()).normalized();
    const Eigen::Vector3d up = across.cross(centre).normalized();
    int seen = 0;
    for (int degree = 0; degree < 360; ++degree) {
      const double turn = degree * 3.14159265358979 / 180.0;
      const Eigen::Vector3d aside = std::cos(turn) * across + std::sin(turn) * up;
      const auto at = [&](double radii) {
        return pixel_of(centre + radii * scene_.balls[ball].radius_m * aside);
      };
      const bool shown = is_inside(at(1.05)) && trace_all(at(0.9)).ball == static_cast<int>(ball);
      const Hit outside = trace_all(at(1.1));
      if (shown && outside.ball == kNothing && outside.panel == kNothing) ++seen;
    }
    return seen;
  }

 private:
  Eigen::Vector2d pixel_of(const Eigen::Vector3d& point) const {
    return {camera_.cx_px + camera_.focal_px * point.x() / point.z(),
            camera_.cy_px + camera_.focal_px * point.y() / point.z()};
  }
  bool is_inside(const Eigen::Vector2d& p) const {
    return p.x() > -0.5 && p.y() > -0.5 && p.x() < camera_.width_px - 0.5 && p.y() < camera_.height_px - 0.5;
  }
  Eigen::Vector3d ray(const Eigen::Vector2d& p) const {
    return {(p.x() - camera_.cx_px) / camera_.focal_px, (p.y() - camera_.cy_px) / camera_.focal_px, 1.0};
  }
  Eigen::Vector3d in_camera(std::size_t ball) const {
    return scene_.balls[ball].in_camera - Eigen::Vector3d(shift_m_, 0.0, 0.0);
  }

  double ball_depth(std::size_t ball, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d centre = in_camera(ball);
    const double a = direction.squaredNorm();
    const double b = direction.dot(centre);
    const double c = centre.squaredNorm() - scene_.balls[ball].radius_m * scene_.balls[ball].radius_m;
    const double discriminant = b * b - a * c;
    return discriminant >= 0.0 ? (b - std::sqrt(discriminant)) / a : std::numeric_limits<double>::infinity();
  }

  // Only the balls whose rows come near this one are looked at.
  void choose_row(int y) {
    near_.clear();
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
      const Eigen::Vector3d centre = in_camera(i);
      const double v = camera_.cy_px + camera_.focal_px * centre.y() / centre.z();
      const double reach = 1.5 * camera_.focal_px * scene_.balls[i].radius_m / centre.z() + 2.0;
      if (std::abs(v - y) > reach) continue;
      const double u = camera_.cx_px + camera_.focal_px * centre.x() / centre.z();
      near_.push_back({i, u - reach, u + reach});
    }
  }

  void trace_panels(const Eigen::Vector3d& direction, Hit& hit) const {
    for (std::size_t i = 0; i < scene_.panels.size(); ++i) {
      const Panel& panel = scene_.panels[i];
      const double x = direction.x() * panel.depth_m + shift_m_;
      const double y = direction.y() * panel.depth_m;
      if (panel.depth_m >= hit.depth_m || x < panel.min_x_m || x > panel.max_x_m || y < panel.min_y_m ||
          y > panel.max_y_m)
        continue;
      hit = {panel.depth_m, kNothing, static_cast<int>(i)};
    }
  }

  void trace_ball(std::size_t ball, const Eigen::Vector3d& direction, Hit& hit) const {
    const double depth = ball_depth(ball, direction);
    if (depth < hit.depth_m) hit = {depth, static_cast<int>(ball), kNothing};
  }

  Hit trace_all(const Eigen::Vector2d& p) const {
    Hit hit;
    trace_panels(ray(p), hit);
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) trace_ball(i, ray(p), hit);
    return hit;
  }

  Hit trace(const Eigen::Vector2d& p) const {
    Hit hit;
    trace_panels(ray(p), hit);
    for (const Near& near : near_) {
      if (p.x() >= near.from_x && p.x() <= near.to_x) trace_ball(near.ball, ray(p), hit);
    }
    return hit;
  }

  Eigen::Vector3d shade(const Eigen::Vector2d& p, const Hit& hit) const {
    if (hit.ball != kNothing) {
      const auto ball = static_cast<std::size_t>(hit.ball);
      const Eigen::Vector3d normal = (ray(p) * hit.depth_m - in_camera(ball)) / scene_.balls[ball].radius_m;
      const Eigen::Vector3d light = scene_.towards_light_source.normalized();
      const double shading = kAmbient + kDiffuse * std::pow(std::max(0.0, normal.dot(light)), scene_.sheen);
      const PaletteColour& colour = kPalette[static_cast<std::size_t>(scene_.balls[ball].colour)];
      return shading * Eigen::Vector3d(colour.b, colour.g, colour.r);
    }
    if (hit.panel != kNothing) return scene_.panels[static_cast<std::size_t>(hit.panel)].bgr;
    return backdrop(p);
  }

  Eigen::Vector3d backdrop(const Eigen::Vector2d& p) const {
    if (scene_.backdrop == Backdrop::kPlain) return scene_.plain_bgr;
    const double far_m = 8.0;
    const double x = ray(p).x() * far_m + shift_m_;
    const double y = ray(p).y() * far_m;
    const double level = y > 0.3 ? tiles(x * 2.0, 12.0 / y) : tiles(x * 0.7, y * 0.7) + 40.0;
    return level * Eigen::Vector3d(0.92, 0.97, 1.0);
  }

  Eigen::Vector3d pixel(int x, int y) const {
    const Eigen::Vector2d centre(x, y);
    const bool empty = std::none_of(near_.begin(), near_.end(), [&](const Near& near) {
      return centre.x() >= near.from_x - 1.0 && centre.x() <= near.to_x + 1.0;
    });
    if (empty && scene_.panels.empty()) return backdrop(centre);
    const Hit middle = trace(centre);
    bool mixed = false;
    for (const auto& [dx, dy] : std::array<std::array<double, 2>, 4>{{{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}})
      mixed = mixed || !(trace(centre + 0.6 * Eigen::Vector2d(dx, dy)) == middle);
    if (!mixed && middle.ball == kNothing) return shade(centre, middle);
    const int samples = mixed ? kSamples : 2;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < samples; ++j) {
      for (int i = 0; i < samples; ++i) {
        const Eigen::Vector2d p =
            centre + Eigen::Vector2d((i + 0.5) / samples - 0.5, (j + 0.5) / samples - 0.5);
        sum += shade(p, trace(p));
      }
    }
    return sum / (samples * samples);
  }

  struct Near {
    std::size_t ball;
    double from_x;
    double to_x;
  };

  const Scene& scene_;
  const Intrinsics& camera_;
  double shift_m_;
  std::vector<Near> near_;
};

// What the lens blurs is painted on a finer grid, blurred there, and gathered by the pixels.
cv::Mat blurred_light(const Scene& scene, const StereoRig& rig, double shift_m) {
  constexpr int kFiner = 3;
  StereoRig fine = rig;
  fine.intrinsics.width_px *= kFiner;
  fine.intrinsics.height_px *= kFiner;
  fine.intrinsics.focal_px *= kFiner;
  fine.intrinsics.cx_px = kFiner * (rig.intrinsics.cx_px + 0.5) - 0.5;
  fine.intrinsics.cy_px = kFiner * (rig.intrinsics.cy_px + 0.5) - 0.5;
  cv::Mat light = CameraPainter(scene, fine, shift_m).light();
  cv::GaussianBlur(light, light, {}, kFiner * scene.blur_px, 0.0, cv::BORDER_REPLICATE);
  cv::Mat gathered;
  cv::resize(light, gathered, {rig.intrinsics.width_px, rig.intrinsics.height_px}, 0.0, 0.0, cv::INTER_AREA);
  return gathered;
}

cv::Mat paint_image(const Scene& scene, const StereoRig& rig, double shift_m, Dice& dice) {
  const cv::Mat light =
      scene.blur_px > 0.0 ? blurred_light(scene, rig, shift_m) : CameraPainter(scene, rig, shift_m).light();
  cv::Mat image(light.size(), CV_8UC3);
  const auto* in = light.ptr<double>();
  auto* out = image.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < light.total() * 3; ++i) {
    const double noise = scene.noise_sd_levels > 0.0 ? scene.noise_sd_levels * dice.normal() : 0.0;
    out[i] = static_cast<std::uint8_t>(std::clamp(std::lround(in[i] + noise), 0L, 255L));
  }
  return image;
}

Eigen::Vector2d pinhole(const StereoRig& rig, const Eigen::Vector3d& point, double shift_m) {
  return {rig.intrinsics.cx_px + rig.intrinsics.focal_px * (point.x() - shift_m) / point.z(),
          rig.intrinsics.cy_px + rig.intrinsics.focal_px * point.y() / point.z()};
}

bool fits(const StereoRig& rig, const PaintedBall& ball, const std::vector<PaintedBall>& others,
          double shift_m) {
  const Eigen::Vector2d p = pinhole(rig, ball.in_camera, shift_m);
  const double r = 1.3 * rig.intrinsics.focal_px * ball.radius_m / ball.in_camera.z() + 5.0;
  if (p.x() < r || p.y() < r || p.x() > rig.intrinsics.width_px - 1 - r ||
      p.y() > rig.intrinsics.height_px - 1 - r)
    return false;
  return std::none_of(others.begin(), others.end(), [&](const PaintedBall& other) {
    const double other_r = 1.3 * rig.intrinsics.focal_px * other.radius_m / other.in_camera.z() + 5.0;
    return (pinhole(rig, other.in_camera, shift_m) - p).norm() < r + other_r;
  });
}

}  // namespace

std::uint64_t Dice::next() {
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

double Dice::uniform(double from, double to) {
  return from + (to - from) * (static_cast<double>(next() >> 11) + 0.5) * 0x1p-53;
}

double Dice::normal() {
  return std::sqrt(-2.0 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
}

StereoRig rig_with_pictures_of(int width_px, int height_px) {
  StereoRig rig;
  rig.intrinsics.width_px = width_px;
  rig.intrinsics.height_px = height_px;
  rig.intrinsics.cx_px = 0.5 * (width_px - 1);
  rig.intrinsics.cy_px = 0.5 * (height_px - 1);
  return rig;
}

StereoPair paint(const Scene& scene, const StereoRig& rig) {
  Dice dice(scene.seed);
  const cv::Mat left = paint_image(scene, rig, 0.0, dice);
  return {left, paint_image(scene, rig, rig.baseline_m, dice)};
}

double visible_share(const Scene& scene, const StereoRig& rig, std::size_t ball) {
  return std::min(CameraPainter(scene, rig, 0.0).visible(ball),
                  CameraPainter(scene, rig, rig.baseline_m).visible(ball));
}

double visible_arc_deg(const Scene& scene, const StereoRig& rig, std::size_t ball) {
  return std::min(CameraPainter(scene, rig, 0.0).arc_deg(ball),
                  CameraPainter(scene, rig, rig.baseline_m).arc_deg(ball));
}

std::vector<PaintedBall> scattered_balls(const StereoRig& rig, double min_depth_m, double max_depth_m,
                                         std::uint64_t seed, bool apart) {
  Dice dice(seed + 77);
  std::vector<PaintedBall> balls;
  for (int colour = 0; colour < static_cast<int>(kPalette.size()); ++colour) {
    for (int attempt = 0; attempt < 300; ++attempt) {
      const double z = dice.uniform(min_depth_m, max_depth_m);
      const double u = dice.uniform(0.0, rig.intrinsics.width_px) - rig.intrinsics.cx_px;
      const double v = dice.uniform(0.0, rig.intrinsics.height_px) - rig.intrinsics.cy_px;
      const PaintedBall ball{{u * z / rig.intrinsics.focal_px, v * z / rig.intrinsics.focal_px, z}, colour};
      if (apart && !(fits(rig, ball, balls, 0.0) && fits(rig, ball, balls, rig.baseline_m))) continue;
      balls.push_back(ball);
      break;
    }
  }
  return balls;
}

}  // namespace stereobench::vision::painter
