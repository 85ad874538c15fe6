#include "slam/joint_belief.h"

#include <cmath>
#include <type_traits>

#include "slam/measurement.h"
#include "slam/noise_law.h"

namespace stereobench::slam {

void follow(JointBelief& belief, const PoseBelief& motion) {
  const PoseBelief moved = follow(belief.pose, motion);
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose.topRows<2>() = lever(belief.pose, {moved.mean.x_m, moved.mean.y_m});
  belief.covariance.move_pose(by_pose, moved.covariance);
  belief.pose = moved.mean;
}

JointSurprise surprise(const JointBelief& belief, const JointBelief& at, int landmark,
                       const Observation& observation, long& repairs) {
  const auto j = static_cast<std::size_t>(landmark);
  const LinearSighting linear = linearise_sighting(at.pose, at.landmarks[j]);
  Eigen::Matrix<double, 2, 5> slope;
  slope.leftCols<3>() = linear.by_pose();
  slope.rightCols<2>() = linear.by_landmark;
  Eigen::Matrix<double, 5, 1> off;
  off.head<3>() = displacement(belief.pose, at.pose);
  off.tail<2>() = belief.landmarks[j] - at.landmarks[j];
  const Eigen::Vector2d expected = linear.expected + slope * off;
  const Eigen::Matrix2d covariance =
      slope * belief.covariance.pose_and_landmark(landmark) * slope.transpose() +
      noise_at(observation, expected);
  return {slope, covariance, Factor2(covariance, repairs),
          sighting_residual(observation.range_bearing, expected)};
}

void correct(JointBelief& belief, int landmark, const JointSurprise& seen, long& repairs) {
  JointCovariance::Columns whitened;
  correct(belief, landmark, seen, whitened, repairs);
}

void correct(JointBelief& belief, int landmark, const JointSurprise& seen, JointCovariance::Columns& whitened,
             long& repairs) {
  belief.covariance.with_sighting(landmark, seen.slope, whitened);
  seen.factor.whiten_in_place(whitened);
  const Eigen::Vector2d residual = seen.factor.whiten<1>(seen.residual.transpose()).transpose();
  if (!std::isfinite(whitened.squaredNorm() * residual.squaredNorm())) {
    ++repairs;
    return;
  }
  const auto shift = [&]<int kRows>(Eigen::Index row, std::integral_constant<int, kRows>) {
    return whitened.col(0).segment<kRows>(row) * residual.x() +
           whitened.col(1).segment<kRows>(row) * residual.y();
  };
  belief.pose = displace(belief.pose, shift(0, std::integral_constant<int, 3>()));
  for (std::size_t j = 0; j < belief.landmarks.size(); ++j)
    belief.landmarks[j] +=
        shift(JointCovariance::row_of(static_cast<int>(j)), std::integral_constant<int, 2>());
  belief.covariance.subtract(whitened, repairs);
}

void place(JointBelief& belief, int landmark, const LandmarkBelief& found, long& repairs) {
  const auto j = static_cast<std::size_t>(landmark);
  if (j == belief.landmarks.size()) belief.landmarks.emplace_back();
  belief.landmarks[j] = found.mean;
  belief.covariance.place(landmark, lever(belief.pose, found.mean), found.covariance, repairs);
}

}  // namespace stereobench::slam
