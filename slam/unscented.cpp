#include "slam/unscented.h"

#include "slam/gaussian.h"
#include "slam/measurement.h"
#include "slam/motion.h"
#include "slam/noise_law.h"

namespace stereobench::slam {

PoseBelief Unscented::move(const PoseBelief& belief, const Control& control,
                           const Eigen::Vector2d& control_sd, long& repairs) const {
  const Eigen::Matrix3d root = semidefinite_root<3>(belief.covariance, repairs);
  const Pose centre = advance(belief.mean, control);
  SigmaResiduals<3, 5> residuals;
  for (int point = 0; point < 10; ++point) {
    const int dimension = point / 2;
    const double reach = point % 2 == 0 ? five_.spread : -five_.spread;
    Pose from = belief.mean;
    Control by = control;
    if (dimension < 3) from = displace(from, reach * root.col(dimension));
    if (dimension == 3) by.v_mps += reach * control_sd.x();
    if (dimension == 4) by.w_radps += reach * control_sd.y();
    residuals.col(point) = displacement(advance(from, by), centre);
  }
  const Eigen::Vector3d mean = sigma_mean<3, 5>(residuals, five_);
  return {displace(centre, mean), sigma_covariance<3, 5>(residuals, mean, five_)};
}

Innovation Unscented::expect(const PoseBelief& belief, const LandmarkBelief& landmark,
                             const Observation& observation, long& repairs) const {
  const Eigen::Matrix3d pose_root = semidefinite_root<3>(belief.covariance, repairs);
  const Eigen::Matrix2d landmark_root = semidefinite_root<2>(landmark.covariance, repairs);
  const Eigen::Vector2d centre = predict_sighting(belief.mean, landmark.mean);
  SigmaResiduals<2, 5> residuals;
  for (int point = 0; point < 10; ++point) {
    const int dimension = point / 2;
    const double reach = point % 2 == 0 ? five_.spread : -five_.spread;
    Pose from = belief.mean;
    Eigen::Vector2d to = landmark.mean;
    if (dimension < 3) {
      from = displace(from, reach * pose_root.col(dimension));
    } else {
      to += reach * landmark_root.col(dimension - 3);
    }
    residuals.col(point) = sighting_residual(predict_sighting(from, to), centre);
  }
  const Eigen::Vector2d mean = sigma_mean<2, 5>(residuals, five_);
  Innovation innovation;
  innovation.expected = {centre.x() + mean.x(), wrap_angle(centre.y() + mean.y())};
  innovation.covariance =
      sigma_covariance<2, 5>(residuals, mean, five_) + noise_at(observation, innovation.expected);
  innovation.cross = sigma_cross<3, 2, 5>(pose_root, 0, residuals, five_);
  return innovation;
}

LandmarkBelief Unscented::refine(const LandmarkBelief& landmark, const Pose& robot,
                                 const Observation& observation, long& repairs) const {
  const Eigen::Matrix2d root = semidefinite_root<2>(landmark.covariance, repairs);
  const Eigen::Vector2d centre = predict_sighting(robot, landmark.mean);
  SigmaResiduals<2, 2> residuals;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = two_.spread * root.col(i);
    residuals.col(2 * i) = sighting_residual(predict_sighting(robot, landmark.mean + step), centre);
    residuals.col(2 * i + 1) = sighting_residual(predict_sighting(robot, landmark.mean - step), centre);
  }
  const Eigen::Vector2d mean = sigma_mean<2, 2>(residuals, two_);
  const Eigen::Matrix2d cross = sigma_cross<2, 2, 2>(root, 0, residuals, two_);
  const Eigen::Vector2d expected = centre + mean;
  const long before = repairs;
  const Factor2 factor(sigma_covariance<2, 2>(residuals, mean, two_) + noise_at(observation, expected),
                       repairs);
  if (repairs != before) return landmark;  // neither is uncertain: nothing can be learnt
  const Eigen::Matrix2d gain = factor.divide<2>(cross);
  const Eigen::Vector2d surprise = sighting_residual(observation.range_bearing, expected);
  const Eigen::Matrix2d covariance = landmark.covariance - gain * cross.transpose();
  return {landmark.mean + gain * surprise, 0.5 * (covariance + covariance.transpose())};
}

LandmarkBelief Unscented::found(const Pose& robot, const Observation& observation, long& repairs) const {
  const Eigen::Matrix2d root =
      semidefinite_root<2>(noise_at(observation, observation.range_bearing), repairs);
  const Eigen::Vector2d centre = locate(robot, observation.range_bearing);
  SigmaResiduals<2, 2> residuals;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = two_.spread * root.col(i);
    residuals.col(2 * i) = locate(robot, observation.range_bearing + step) - centre;
    residuals.col(2 * i + 1) = locate(robot, observation.range_bearing - step) - centre;
  }
  const Eigen::Vector2d mean = sigma_mean<2, 2>(residuals, two_);
  return {centre + mean, sigma_covariance<2, 2>(residuals, mean, two_)};
}

}  // namespace stereobench::slam
