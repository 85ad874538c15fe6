#include "tests/harness/dataset_import/painted_euroc.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "harness/io/picture_file.h"

namespace stereobench::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A camera that looks along the body's z axis, its rows along y, but for a small turn.
PaintedCamera camera(std::array<double, 4> pinhole, std::array<double, 4> lens, const Vector3d& place_m,
                     const Vector3d& turn_rad) {
  Matrix3d axes;
  axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  PaintedCamera made = {pinhole[0], pinhole[1], pinhole[2], pinhole[3], lens, Eigen::Isometry3d::Identity()};
  made.body_from_camera.linear() = axes * Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).matrix();
  made.body_from_camera.translation() = place_m;
  return made;
}

Vector2d distorted(const std::array<double, 4>& lens, const Vector2d& p) {
  const auto& [k1, k2, p1, p2] = lens;
  const double r2 = p.squaredNorm(), radial = 1.0 + k1 * r2 + k2 * r2 * r2;
  return {radial * p.x() + 2.0 * p1 * p.x() * p.y() + p2 * (r2 + 2.0 * p.x() * p.x()),
          radial * p.y() + p1 * (r2 + 2.0 * p.y() * p.y()) + 2.0 * p2 * p.x() * p.y()};
}

// The direction of a pixel, by fixed-point iteration.
Vector3d direction_of(const PaintedCamera& camera, double u, double v) {
  const Vector2d seen((u - camera.cu) / camera.fu, (v - camera.cv) / camera.fv);
  Vector2d straight = seen;
  for (int i = 0; i < 15; ++i) straight += seen - distorted(camera.lens, straight);
  return straight.homogeneous().normalized();
}

// Light of a ray, blue first: matt balls under a lamp behind the camera, before a grey wall.
Vector3d light_along(const std::vector<PaintedBall>& balls, const Vector3d& from, const Vector3d& along) {
  Vector3d light(70, 70, 70);
  double nearest = std::numeric_limits<double>::infinity();
  for (const PaintedBall& ball : balls) {
    const Vector3d to = ball.centre_m - from;
    const double ahead = to.dot(along);
    const double inside =
        PaintedEuroc::kRadius_m * PaintedEuroc::kRadius_m - (to - ahead * along).squaredNorm();
    if (inside <= 0.0 || ahead - std::sqrt(inside) >= nearest) continue;
    nearest = ahead - std::sqrt(inside);
    const Vector3d normal = (nearest * along - to).normalized();
    const Vector3d paint = ball.colour == 0 ? Vector3d(0, 0, 229) : Vector3d(229, 0, 0);
    light = (0.5 + 0.5 * std::max(0.0, normal.dot(Vector3d(-0.6, 0.0, 0.8)))) * paint;
  }
  return light;
}

cv::Mat painted(const PaintedEuroc& set, const PaintedCamera& camera,
                const Eigen::Isometry3d& world_from_body) {
  constexpr int kRays = 4;
  const Eigen::Isometry3d pose = world_from_body * camera.body_from_camera;
  cv::Mat picture(PaintedEuroc::kHeight, PaintedEuroc::kWidth, CV_8UC3);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u) {
      Vector3d light = Vector3d::Zero();
      for (int i = 0; i < kRays * kRays; ++i) {
        const double du = (i % kRays + 0.5) / kRays - 0.5, dv = (i / kRays + 0.5) / kRays - 0.5;
        light +=
            light_along(set.balls, pose.translation(), pose.linear() * direction_of(camera, u + du, v + dv));
      }
      light /= kRays * kRays;
      for (int c = 0; c < 3; ++c) picture.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(light[c]);
    }
  return picture;
}

std::string sensor_yaml(const PaintedCamera& camera) {
  std::string place;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      place += fmt::format("{:.12f}{}", camera.body_from_camera.matrix()(row, column),
                           row == 3 && column == 3 ? "" : ", ");
    place += row == 3 ? "]" : "\n         ";
  }
  return fmt::format(
      "# General sensor definitions.\nsensor_type: camera\ncomment: painted\n\n# Sensor extrinsics.\nT_BS:\n"
      "  cols: 4\n  rows: 4\n  data: [{}\n\n# Camera specific definitions.\nrate_hz: 20\n"
      "resolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [{}, {}, {}, {}] #fu, fv, cu, cv\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: [{}, {}, {}, {}]\n\n",
      place, PaintedEuroc::kWidth, PaintedEuroc::kHeight, camera.fu, camera.fv, camera.cu, camera.cv,
      camera.lens[0], camera.lens[1], camera.lens[2], camera.lens[3]);
}

std::string states_csv() {
  std::string csv =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
      "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
      "b_a_RS_S_z [m s^-2]\r\n";
  for (int i = 0; i < 60; ++i) {
    const std::int64_t stamp_ns = PaintedEuroc::kTruthBegins_ns + i * 5'000'000;
    const Eigen::Isometry3d pose = PaintedEuroc::world_from_body(stamp_ns);
    const Eigen::Quaterniond turn(pose.linear());
    csv += fmt::format("{},{},{},{},{},{},{},{},0.4,0.2,0,-0.002,0.02,0.07,-0.01,0.1,0.03\r\n", stamp_ns,
                       pose.translation().x(), pose.translation().y(), pose.translation().z(), turn.w(),
                       turn.x(), turn.y(), turn.z());
  }
  return csv;
}

}  // namespace

PaintedEuroc::PaintedEuroc()
    : cameras{camera({229.3, 228.6, 183.6, 124.2}, {-0.283, 0.074, 0.0002, 0.00002}, {-0.02, -0.065, 0.01},
                     {0.004, 0.026, 0.015}),
              camera({228.8, 228.1, 190.0, 127.6}, {-0.284, 0.0745, -0.0001, -0.00004},
                     {-0.018, 0.045, 0.008}, {0.018, 0.025, 0.013})},
      balls{{0, {2.0, 1.75, 1.1}}, {2, {2.3, 0.9, 0.8}}} {}

Eigen::Isometry3d PaintedEuroc::world_from_body(std::int64_t stamp_ns) {
  constexpr double kHeading_rad = 0.45;
  const double seconds = 1e-9 * static_cast<double>(stamp_ns - kFirst_ns);
  const double c = std::cos(kHeading_rad), s = std::sin(kHeading_rad);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = Vector3d::UnitZ();     // up
  pose.linear().col(1) = Vector3d(s, -c, 0.0);  // right
  pose.linear().col(2) = Vector3d(c, s, 0.0);   // forward
  pose.translation() = Vector3d(0.3, 0.4, 1.0) + seconds * Vector3d(0.4, 0.2, 0.0);
  return pose;
}

void PaintedEuroc::write(const TestFolder& folder) const {
  folder.write("mav0/body.yaml", "comment: painted\n");
  folder.write("mav0/state_groundtruth_estimate0/data.csv", states_csv());
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string camera = fmt::format("mav0/cam{}/", side);
    std::string list = "#timestamp [ns],filename\r\n";
    for (int frame = 0; frame < kFrames - static_cast<int>(side); ++frame) {
      const std::string name = fmt::format("{}.png", stamp_ns(frame));
      list += fmt::format("{},{}\r\n", stamp_ns(frame), name);
      folder.write(camera + "data/" + name,
                   encoded(".png", painted(*this, cameras[side], world_from_body(stamp_ns(frame)))));
    }
    folder.write(camera + "data.csv", list);
    folder.write(camera + "sensor.yaml", sensor_yaml(cameras[side]));
  }
}

}  // namespace stereobench::harness
