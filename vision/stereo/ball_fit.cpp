#include "vision/stereo/ball_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "vision/camera/rig.h"
#include "vision/outline/outline_model.h"
#include "vision/stereo/sphere.h"
#include "vision/tuning/match.h"

namespace stereobench::vision {
namespace {

// What a fault of the right camera adds to its outline's covariance. A turn about y that moves an outline
// also stretches it, by the cube of the root of its ray's length: else a stretch of a tenth of a pixel would
// pass for a disparity that is off by dozens.
Eigen::Matrix3d noise_by_fault_px2(const Intrinsics& camera, const MeasuredOutline& outline,
                                   double disparity_variance_px2) {
  const Eigen::Vector3d ray = pixel_ray(camera, outline.centre_px);
  const double stretch = 1.5 * outline.radius_px * ray.x() / (camera.focal_px * ray.squaredNorm());
  return disparity_variance_px2 * Eigen::Vector3d(1.0, 0.0, stretch * stretch).asDiagonal().toDenseMatrix();
}

// Two outlines of one ball, as the cameras measured them.
class BallResiduals {
 public:
  BallResiduals(const StereoRig& rig, const MeasuredOutline& left, const MeasuredOutline& right,
                double disparity_variance_px2)
      : camera_(rig.intrinsics),
        to_right_(-rig.baseline_m, 0.0, 0.0, 0.0),
        left_(as_vector(left)),
        right_(as_vector(right)),
        left_noise_(left.covariance_px2),
        right_noise_(right.covariance_px2 +
                     noise_by_fault_px2(rig.intrinsics, right, disparity_variance_px2)) {}

  // One step towards the ball that explains both.
  // @param size of a ball before it is looked at
  // @return covariance of the ball
  Eigen::Matrix4d improve(SizedBall& ball, const BallSize& size) const {
    const double size_information = 1.0 / (size.radius_sd_m * size.radius_sd_m);
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    information(3, 3) = size_information;
    Eigen::Vector4d evidence(0.0, 0.0, 0.0, size_information * (size.radius_m - ball.w()));
    const auto add = [&](const SeenOutline& seen, const Eigen::Vector3d& outline, const auto& noise) {
      const Eigen::Matrix<double, 4, 3> weighted = noise.solve(seen.by_ball).transpose();
      information.noalias() += weighted * seen.by_ball;
      evidence.noalias() += weighted * (outline - seen.outline_px);
    };
    add(seen_outline(camera_, ball), left_, left_noise_);
    add(seen_outline(camera_, ball + to_right_), right_, right_noise_);
    const Eigen::LDLT<Eigen::Matrix4d> solver(information);
    ball += solver.solve(evidence);
    return solver.solve(Eigen::Matrix4d::Identity());
  }

  Eigen::Vector3d left_residual(const SizedBall& ball) const {
    return left_ - seen_outline(camera_, ball).outline_px;
  }
  Eigen::Vector3d right_residual(const SizedBall& ball) const {
    return right_ - seen_outline(camera_, ball + to_right_).outline_px;
  }

 private:
  static Eigen::Vector3d as_vector(const MeasuredOutline& outline) {
    return {outline.centre_px.x(), outline.centre_px.y(), outline.radius_px};
  }

  Intrinsics camera_;
  Eigen::Vector4d to_right_;
  Eigen::Vector3d left_, right_;
  Eigen::LDLT<Eigen::Matrix3d> left_noise_, right_noise_;
};

bool is_ahead(const SizedBall& ball) {
  return ball.allFinite() && ball.w() > 0.0 && ball.z() > 1.01 * ball.w();
}

// Puts a ball and its covariance into a fit. @return whether there is such a ball
bool put(const SizedBall& ball, const Eigen::Matrix4d& covariance, BallFit& fit) {
  if (!is_ahead(ball) || !covariance.allFinite()) return false;
  fit.ball_in_camera = ball.head<3>();
  fit.covariance_m2 = 0.5 * (covariance.topLeftCorner<3, 3>() + covariance.topLeftCorner<3, 3>().transpose());
  fit.radius_m = ball.w();
  fit.radius_variance_m2 = covariance(3, 3);
  return true;
}

// Semi-minor axis of an outline at unit depth.
double minor_axis(const Intrinsics& camera, const MeasuredOutline& outline) {
  return OutlineModel(camera, outline.centre_px, outline.radius_px).semi_minor_px() / camera.focal_px;
}

// Where a ball is by its size, whatever the disparity says.
std::optional<Eigen::Vector3d> place_by_size(const StereoRig& rig, const MeasuredOutline& left,
                                             const MeasuredOutline& right, double ball_radius_m) {
  const Eigen::Vector2d disparity(disparity_by_size_px(rig, left, right, ball_radius_m), 0.0);
  return triangulate_ball(rig, left.centre_px, left.centre_px - disparity, ball_radius_m);
}

// By how much a ball's radius contradicts its size, squared; 0 where that may be chance.
double contradiction_m2(const BallSize& size, const BallFit& loose) {
  const double off_m = loose.radius_m - size.radius_m;
  const double by_chance_m2 = loose.radius_variance_m2 + size.radius_sd_m * size.radius_sd_m;
  return off_m * off_m > kBallFit.believed * by_chance_m2 ? off_m * off_m : 0.0;
}

}  // namespace

double disparity_by_size_px(const StereoRig& rig, const MeasuredOutline& left, const MeasuredOutline& right,
                            double ball_radius_m) {
  const double b = 0.5 * (minor_axis(rig.intrinsics, left) + minor_axis(rig.intrinsics, right));
  return rig.intrinsics.focal_px * rig.baseline_m * b * std::sqrt(1.0 + b * b) / ball_radius_m;
}

std::optional<BallFit> fit_ball(const StereoRig& rig, const MeasuredOutline& left,
                                const MeasuredOutline& right, double ball_radius_m,
                                double disparity_variance_px2) {
  const auto start = disparity_variance_px2 > 0.0
                         ? place_by_size(rig, left, right, ball_radius_m)
                         : triangulate_ball(rig, left.centre_px, right.centre_px, ball_radius_m);
  if (!start) return std::nullopt;
  const BallResiduals pair(rig, left, right, disparity_variance_px2);
  SizedBall ball(start->x(), start->y(), start->z(), ball_radius_m);
  Eigen::Matrix4d covariance;
  for (int step = 0; step < kBallFit.steps; ++step) {
    if (!is_ahead(ball)) return std::nullopt;
    covariance = pair.improve(ball, {ball_radius_m, kBallFit.loose_sd * ball_radius_m});
  }
  BallFit fit;
  if (!put(ball, covariance, fit)) return std::nullopt;
  const Eigen::Vector3d left_residual = pair.left_residual(ball);
  const Eigen::Vector3d right_residual = pair.right_residual(ball);
  fit.row_misfit_px = std::abs(left_residual.y() - right_residual.y());
  const double size_misfit_px =
      std::abs(ball.w() / ball_radius_m - 1.0) * std::max(left.radius_px, right.radius_px);
  fit.radius_misfit_px =
      std::max({std::abs(left_residual.z()), std::abs(right_residual.z()), size_misfit_px});
  return fit;
}

BallFit fit_ball_of_size(const StereoRig& rig, const MeasuredOutline& left, const MeasuredOutline& right,
                         const BallSize& size, const BallFit& loose, double disparity_variance_px2) {
  const double off_m2 = contradiction_m2(size, loose);
  const double by_size_px = disparity_by_size_px(rig, left, right, size.radius_m);
  const double off_px2 = off_m2 * by_size_px * by_size_px / (size.radius_m * size.radius_m);
  const double told_sd_m = std::sqrt(size.radius_sd_m * size.radius_sd_m + off_m2);
  const BallSize believed = {size.radius_m, std::clamp(told_sd_m, kBallFit.exact_sd * size.radius_m,
                                                       kBallFit.loose_sd * size.radius_m)};
  const BallResiduals pair(rig, left, right, disparity_variance_px2 + off_px2);
  SizedBall ball;
  ball << loose.ball_in_camera, loose.radius_m;
  Eigen::Matrix4d covariance;
  for (int step = 0; step < kBallFit.further_steps; ++step) {
    if (!is_ahead(ball)) return loose;
    covariance = pair.improve(ball, believed);
  }
  BallFit fit = loose;
  put(ball, covariance, fit);
  return fit;
}

}  // namespace stereobench::vision
