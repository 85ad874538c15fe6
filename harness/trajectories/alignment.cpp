#include "harness/trajectories/alignment.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

using slam::arc_tangent;

/// Singular values below this share of the largest say nothing.
constexpr double kDegenerate = 1e-9;

bool has_scale(AlignmentKind kind) {
  return kind == AlignmentKind::kSim2 || kind == AlignmentKind::kSim3;
}

/// @return the two axes of a plane
std::array<Eigen::Index, 2> axes_of(Plane plane) {
  if (plane == Plane::kXy) return {0, 1};
  return plane == Plane::kXz ? std::array<Eigen::Index, 2>{0, 2} : std::array<Eigen::Index, 2>{1, 2};
}

/// Puts the plane's axes first, so that all that follows is in x and y.
PoseInSpace projected(const PoseInSpace& pose, const std::array<Eigen::Index, 2>& axes) {
  const auto [a, b] = axes;
  const double turned =
      arc_tangent(pose.rotation(b, a) - pose.rotation(a, b), pose.rotation(a, a) + pose.rotation(b, b));
  const auto [sine, cosine] = slam::sine_cosine(turned);
  PoseInSpace flat;
  flat.rotation.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  flat.position_m << pose.position_m(a), pose.position_m(b), 0.0;
  return flat;
}

Eigen::Matrix3Xd positions_of(const std::vector<PoseInSpace>& poses) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    positions.col(static_cast<Eigen::Index>(i)) = poses[i].position_m;
  return positions;
}

/// @param positions of a path @param centred the same without their mean
void require_spread(const char* path, const Eigen::Matrix3Xd& positions, const Eigen::MatrixXd& centred) {
  if (centred.cwiseAbs().maxCoeff() > kDegenerate * positions.cwiseAbs().maxCoeff()) return;
  throw std::runtime_error(fmt::format(
      "--align: the {} positions of {} coincide and do not say how to turn; expected origin or none",
      positions.cols(), path));
}

/// @param d how many dimensions the positions have: 2 or 3
Alignment umeyama(const TrajectoryPairs& pairs, Eigen::Index d, bool scales) {
  const Eigen::Matrix3Xd estimate = positions_of(pairs.estimate), truth = positions_of(pairs.truth);
  const Eigen::Vector3d estimate_mean = estimate.rowwise().mean(), truth_mean = truth.rowwise().mean();
  const Eigen::MatrixXd from = (estimate.colwise() - estimate_mean).topRows(d);
  const Eigen::MatrixXd to = (truth.colwise() - truth_mean).topRows(d);
  require_spread("the estimate", estimate, from);
  require_spread("the truth", truth, to);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(to * from.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();
  if (d == 3 && !(values(1) > kDegenerate * values(0)))
    throw std::runtime_error(
        "--align: the positions lie on a line and do not say how to roll; expected se2, origin or none");
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(d);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs(d - 1) = -1.0;
  Alignment alignment;
  alignment.rotation.topLeftCorner(d, d) = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  if (scales) {
    alignment.scale = values.dot(signs) / from.squaredNorm();
    const bool fits = values.dot(signs) > kDegenerate * values(0);
    if (!fits || !std::isfinite(alignment.scale) || !(alignment.scale > 0.0))
      throw std::runtime_error("--align: the positions do not say how to scale; expected se2, se3 or origin");
  }
  alignment.translation_m = truth_mean - alignment.scale * alignment.rotation * estimate_mean;
  return alignment;
}

}  // namespace

bool is_in_plane(AlignmentKind kind) {
  return kind == AlignmentKind::kSe2 || kind == AlignmentKind::kSim2;
}

TrajectoryPairs in_plane(TrajectoryPairs pairs, Plane plane) {
  for (PoseInSpace& pose : pairs.estimate) pose = projected(pose, axes_of(plane));
  for (PoseInSpace& pose : pairs.truth) pose = projected(pose, axes_of(plane));
  return pairs;
}

Alignment align(const TrajectoryPairs& pairs, AlignmentKind kind) {
  if (kind == AlignmentKind::kNone) return {};
  if (kind == AlignmentKind::kOrigin) {
    const PoseInSpace& from = pairs.estimate.front();
    const PoseInSpace& to = pairs.truth.front();
    const Eigen::Matrix3d rotation = to.rotation * from.rotation.transpose();
    return {rotation, to.position_m - rotation * from.position_m};
  }
  return umeyama(pairs, is_in_plane(kind) ? 2 : 3, has_scale(kind));
}

std::vector<PoseInSpace> aligned(const std::vector<PoseInSpace>& estimate, const Alignment& alignment) {
  std::vector<PoseInSpace> there;
  for (const PoseInSpace& pose : estimate)
    there.push_back({alignment.rotation * pose.rotation,
                     alignment.scale * (alignment.rotation * pose.position_m) + alignment.translation_m});
  return there;
}

}  // namespace stereobench::harness
