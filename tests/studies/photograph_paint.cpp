#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "tests/studies/photograph.h"

namespace stereobench::photograph {
namespace {

constexpr int kDense = 3;  // looks a pixel, each way

double smooth_step(double low, double high, double at) {
  const double t = std::clamp((at - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// A number in [0, 1) for each cell of a lattice.
double lattice(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(x) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(y) * 0x94D049BB133111EBULL;
  h = (h ^ (h >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ (h >> 31U)) >> 11U) * 0x1p-53;
}

/// Smooth noise of unit cells, in [-1, 1].
double noise(double x, double y, std::uint64_t seed) {
  const double left = std::floor(x), top = std::floor(y);
  const double u = smooth_step(0.0, 1.0, x - left), v = smooth_step(0.0, 1.0, y - top);
  const auto at = [&](int i, int j) {
    return lattice(static_cast<std::int64_t>(left) + i, static_cast<std::int64_t>(top) + j, seed);
  };
  return 2.0 *
             ((1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) + v * ((1.0 - u) * at(0, 1) + u * at(1, 1))) -
         1.0;
}

/// What the ground is painted with at a place, in heights of the camera.
Light ground_paint(const Scene& scene, double x, double z) {
  const auto n = [&](double scale, std::uint64_t part) {
    return noise(scale * x, scale * z, scene.seed + part);
  };
  switch (scene.ground) {
    case Ground::kGrass: {
      const double blades = noise(160.0 * x, 45.0 * z, scene.seed + 1);
      return scene.ground_paint * (1.0 + 0.55 * blades + 0.25 * n(12.0, 2)) *
             Light(1.0 + 0.25 * n(60.0, 3), 1.0, 1.0 + 0.2 * n(40.0, 4));
    }
    case Ground::kWood: {
      const double board = std::floor(6.0 * x);
      const double gap = std::abs(6.0 * x - board - 0.5) > 0.485 ? 0.35 : 1.0;
      const double grain = noise(90.0 * x, 3.0 * z + 7.0 * board, scene.seed + 1);
      return scene.ground_paint * gap * (1.0 + 0.2 * grain + 0.15 * noise(board, 0.5, scene.seed + 2));
    }
    case Ground::kGravel:
      return scene.ground_paint * (1.0 + 0.45 * n(70.0, 1) + 0.2 * n(25.0, 2));
    case Ground::kCloth:
      return scene.ground_paint * (1.0 + 0.12 * n(120.0, 1) + 0.08 * n(6.0, 2));
  }
  return Light::Zero();
}

/// A ball as it stands on the ground, in heights of the camera: x right, y up, z to the camera.
Eigen::Vector3d standing(const Scene& scene, const Ball& ball) {
  const double contact_px = ball.centre_px.y() + ball.radius_px - scene.horizon_px;
  const double focal_px = scene.width_px;
  return {(ball.centre_px.x() - 0.5 * scene.width_px) / contact_px, scene.ball_radius,
          -focal_px / contact_px};
}

/// What reaches a place of the ground: all balls stand in the sun's way, and in the sky's where they touch.
Light ground_light(const Scene& scene, const Eigen::Vector3d& place) {
  double sun = std::max(0.0, scene.to_sun.y());
  double sky = 1.0;
  for (const Ball& ball : scene.balls) {
    const Eigen::Vector3d to_ball = standing(scene, ball) - place;
    const double along = to_ball.dot(scene.to_sun);
    const double aside = (to_ball - along * scene.to_sun).norm();
    if (along > 0.0) sun *= smooth_step(0.85, 1.1, aside / scene.ball_radius);
    const double apart =
        to_ball.head<3>().cwiseProduct(Eigen::Vector3d(1.0, 0.0, 1.0)).norm() / scene.ball_radius;
    sky *= 1.0 - 0.75 * std::exp(-1.3 * apart * apart);
  }
  return scene.sky * sky + scene.sun * sun;
}

/// How much of a ball's own colour its dress leaves, and of the second one, at a point of its surface.
double second_colour(const Ball& ball, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d on = ball.turn * normal;
  switch (ball.dress) {
    case Dress::kSeams:
      return std::min({std::abs(on.x()), std::abs(on.y()), std::abs(on.z())}) < 0.025 ? 1.0 : 0.0;
    case Dress::kCurvedSeam: {  // x^2 - y^2 = a z is close to a tennis ball's
      const double curve = on.x() * on.x() - on.y() * on.y() - 0.9 * on.z();
      return std::abs(curve) < 0.06 ? 1.0 : 0.0;
    }
    case Dress::kPrint: {  // three bars, on two sides
      const bool on_patch = std::abs(on.z()) > 0.8;
      return on_patch && std::abs(std::fmod(on.x() + 2.0, 0.36) - 0.18) < 0.09 ? 1.0 : 0.0;
    }
    case Dress::kPlain:
    case Dress::kFelt:
      return 0.0;
  }
  return 0.0;
}

Light ball_light(const Scene& scene, const Ball& ball, const Eigen::Vector3d& normal) {
  const double second = second_colour(ball, normal);
  Light paint = (1.0 - second) * ball.paint + second * ball.second;
  if (ball.dress == Dress::kFelt) {
    const Eigen::Vector3d on = 40.0 * (ball.turn * normal);
    paint *= 1.0 + 0.15 * noise(on.x() + on.z(), on.y() - 0.5 * on.z(), scene.seed + 9);
  }
  const double up = normal.y();
  const double sun = std::max(0.0, normal.dot(scene.to_sun));
  const double contact = 1.0 - 0.7 * smooth_step(0.45, 1.0, -up);  // the ground is dark where it touches
  const Light below = scene.ground_paint * (scene.sky + scene.sun * std::max(0.0, scene.to_sun.y()));
  Light light = paint * (scene.sky * (0.5 + 0.5 * up) + below * (0.5 - 0.5 * up) * contact + scene.sun * sun);
  const Eigen::Vector3d half = (scene.to_sun + Eigen::Vector3d::UnitZ()).normalized();
  const double mirror = std::pow(std::max(0.0, normal.dot(half)), ball.sharpness);
  const double grazing = std::pow(1.0 - std::max(0.0, normal.z()), 5.0);
  light += ball.sheen * (scene.sun * mirror * 1.5 + 0.35 * grazing * (up > 0.0 ? scene.sky : below));
  return light;
}

bool is_within(const Clutter& thing, const Eigen::Vector2d& at) {
  const Eigen::Vector2d from = Eigen::Rotation2Dd(-thing.turn_rad) * (at - thing.centre_px);
  const Eigen::Vector2d share = from.cwiseQuotient(thing.half_px).cwiseAbs();
  return thing.is_leaf ? share.x() + share.y() * share.y() < 1.0 : share.maxCoeff() < 1.0;
}

/// Grass before a ball: blades by column, up from where it stands.
bool is_blade(const Scene& scene, const Ball& ball, const Eigen::Vector2d& at, std::uint64_t part) {
  if (scene.ground != Ground::kGrass) return false;
  const double above = (ball.centre_px.y() + ball.radius_px - at.y()) / ball.radius_px;
  const double tallest = 0.05 + 0.15 * lattice(static_cast<std::int64_t>(part), 77, scene.seed);
  const double column =
      at.x() * 25.0 / ball.radius_px + 2.0 * noise(at.y() * 8.0 / ball.radius_px, 0.5, part);
  return above < tallest * (0.5 + 0.5 * noise(column, 0.5, scene.seed + part));
}

/// What a look sees: its light, and which ball.
struct Seen {
  Light light;
  int ball = -1;
};

Seen background(const Scene& scene, const Eigen::Vector2d& at) {
  for (auto thing = scene.behind.rbegin(); thing != scene.behind.rend(); ++thing)
    if (is_within(*thing, at)) return {thing->paint * (scene.sky + 0.6 * scene.sun)};
  const double below_px = at.y() - scene.horizon_px;
  if (below_px < 2.0) {
    const double rough = noise(0.02 * at.x(), 0.05 * at.y(), scene.seed + 5);
    return {scene.wall_paint * (scene.sky + 0.5 * scene.sun) * (1.0 + 0.2 * rough)};
  }
  const double x = (at.x() - 0.5 * scene.width_px) / below_px;
  const double z = scene.width_px / below_px;
  return {ground_paint(scene, x, z) * ground_light(scene, {x, 0.0, -z})};
}

Seen look(const Scene& scene, const Eigen::Vector2d& at) {
  for (const Clutter& thing : scene.before)
    if (is_within(thing, at)) return {thing.paint * (scene.sky + 0.6 * scene.sun)};
  for (std::size_t i = scene.balls.size(); i-- > 0;) {
    const Ball& ball = scene.balls[i];
    const Eigen::Vector2d from = (at - ball.centre_px) / ball.radius_px;
    if (from.squaredNorm() >= 1.0) continue;
    if (is_blade(scene, ball, at, i + 11)) {
      const double shade = 0.7 + 0.5 * noise(at.x() * 30.0 / ball.radius_px, 0.02 * at.y(), scene.seed + 6);
      return {scene.ground_paint * shade * (scene.sky + 0.5 * scene.sun)};
    }
    const Eigen::Vector3d normal(from.x(), -from.y(), std::sqrt(1.0 - from.squaredNorm()));
    return {ball_light(scene, ball, normal), static_cast<int>(i)};
  }
  return background(scene, at);
}

}  // namespace

cv::Mat paint(const Scene& scene, std::vector<Ball>& balls) {
  balls = scene.balls;
  cv::Mat light(scene.height_px, scene.width_px, CV_32FC3);
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      Light sum = Light::Zero();
      for (int k = 0; k < kDense * kDense; ++k) {
        const Eigen::Vector2d within((k % kDense + 0.5) / kDense - 0.5, (k / kDense + 0.5) / kDense - 0.5);
        const Seen seen = look(scene, Eigen::Vector2d(column, row) + within);
        sum += seen.light / (kDense * kDense);
        if (seen.ball >= 0) balls[static_cast<std::size_t>(seen.ball)].visible += 1.0 / (kDense * kDense);
      }
      const Eigen::Array3f bgr = sum.reverse().cast<float>();
      light.at<cv::Vec3f>(row, column) = {bgr[0], bgr[1], bgr[2]};
    }
  }
  for (Ball& ball : balls) ball.visible /= 3.14159265358979 * ball.radius_px * ball.radius_px;
  return light;
}

}  // namespace stereobench::photograph
