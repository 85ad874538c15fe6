#include "vision/ball_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "vision/sphere.h"

namespace stereobench::vision {
namespace {

constexpr double kSizeSd = 0.1;  // of what is believed of a ball's radius, relative
constexpr int kSteps = 4;

using Ball = Eigen::Vector4d;  // X, Y, Z in the eye or the left camera, and the radius, metres
using OutlineByBall = Eigen::Matrix<double, 3, 4>;

// Centre and radius of the outline that a ball has in an eye, and their derivatives (sphere.h).
struct SeenBall {
  Eigen::Vector3d outline_px = Eigen::Vector3d::Zero();
  OutlineByBall by_ball = OutlineByBall::Zero();
};

SeenBall see(const Intrinsics& camera, const Ball& ball) {
  const double z = ball.z();
  const double radius = ball.w();
  const double gap = z * z - radius * radius;
  const double tangent2 = ball.head<3>().squaredNorm() - radius * radius;  // squared length of a tangent
  const double f = camera.focal_px;
  SeenBall seen;
  for (int axis = 0; axis < 2; ++axis) {
    seen.outline_px[axis] = f * ball[axis] * z / gap + (axis == 0 ? camera.cx_px : camera.cy_px);
    seen.by_ball(axis, axis) = f * z / gap;
    seen.by_ball(axis, 2) = f * ball[axis] * (1.0 - 2.0 * z * z / gap) / gap;
    seen.by_ball(axis, 3) = 2.0 * f * ball[axis] * z * radius / (gap * gap);
  }
  const double outline_radius = f * radius * std::sqrt(std::sqrt(tangent2 / gap) / gap);
  seen.outline_px[2] = outline_radius;
  const double by_tangent = 0.5 * outline_radius / tangent2;
  const double by_gap = -1.5 * outline_radius / gap;
  seen.by_ball.row(2) << by_tangent * ball.x(), by_tangent * ball.y(), (by_tangent + by_gap) * z,
      outline_radius / radius - (by_tangent + by_gap) * radius;
  return seen;
}

Eigen::Vector3d as_vector(const MeasuredOutline& outline) {
  return {outline.centre_px.x(), outline.centre_px.y(), outline.radius_px};
}

bool is_ahead(const Ball& ball) {
  return ball.allFinite() && ball.w() > 0.0 && ball.z() > 1.01 * ball.w();
}

}  // namespace

std::optional<BallFit> fit_ball(const StereoRig& rig, const MeasuredOutline& left,
                                const MeasuredOutline& right, double ball_radius_m) {
  const auto start = triangulate_ball(rig, left.centre_px, right.centre_px, ball_radius_m);
  if (!start) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> left_noise(left.covariance_px2);
  const Eigen::LDLT<Eigen::Matrix3d> right_noise(right.covariance_px2);
  const double size_sd_m = kSizeSd * ball_radius_m;
  const double size_information = 1.0 / (size_sd_m * size_sd_m);
  const Eigen::Vector4d to_right(-rig.baseline_m, 0.0, 0.0, 0.0);

  Ball ball(start->x(), start->y(), start->z(), ball_radius_m);
  Eigen::LDLT<Eigen::Matrix4d> solver;
  for (int step = 0; step < kSteps; ++step) {
    if (!is_ahead(ball)) return std::nullopt;
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    information(3, 3) = size_information;
    Eigen::Vector4d evidence(0.0, 0.0, 0.0, size_information * (ball_radius_m - ball.w()));
    const auto add = [&](const SeenBall& seen, const MeasuredOutline& outline, const auto& noise) {
      const Eigen::Matrix<double, 4, 3> weighted = noise.solve(seen.by_ball).transpose();
      information.noalias() += weighted * seen.by_ball;
      evidence.noalias() += weighted * (as_vector(outline) - seen.outline_px);
    };
    add(see(rig.camera, ball), left, left_noise);
    add(see(rig.camera, ball + to_right), right, right_noise);
    solver.compute(information);
    ball += solver.solve(evidence);
  }
  if (!is_ahead(ball)) return std::nullopt;
  const Eigen::Matrix4d covariance = solver.solve(Eigen::Matrix4d::Identity());
  if (!covariance.allFinite()) return std::nullopt;
  const Eigen::Vector3d left_residual = as_vector(left) - see(rig.camera, ball).outline_px;
  const Eigen::Vector3d right_residual = as_vector(right) - see(rig.camera, ball + to_right).outline_px;
  BallFit fit;
  fit.ball_in_camera = ball.head<3>();
  fit.covariance_m2 = 0.5 * (covariance.topLeftCorner<3, 3>() + covariance.topLeftCorner<3, 3>().transpose());
  fit.row_misfit_px = std::abs(left_residual.y() - right_residual.y());
  const double size_misfit_px =
      std::abs(ball.w() / ball_radius_m - 1.0) * std::max(left.radius_px, right.radius_px);
  fit.radius_misfit_px =
      std::max({std::abs(left_residual.z()), std::abs(right_residual.z()), size_misfit_px});
  return fit;
}

}  // namespace stereobench::vision
