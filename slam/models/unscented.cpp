#include "slam/models/unscented.h"

#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "slam/models/noise_law.h"

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
    if (dimension < 3) from = boxplus(from, reach * root.col(dimension));
    if (dimension == 3) by.v_mps += reach * control_sd.x();
    if (dimension == 4) by.w_radps += reach * control_sd.y();
    residuals.col(point) = boxminus(advance(from, by), centre);
  }
  const Eigen::Vector3d mean = sigma_mean<3, 5>(residuals, five_);
  return {boxplus(centre, mean), sigma_covariance<3, 5>(residuals, mean, five_)};
}

PredictedMeasurement Unscented::expect(const PoseBelief& belief, const LandmarkBelief& landmark,
                                       const Observation& observation, long& repairs) const {
  const PivotedRoot<2> spread = pivoted_root<2>(landmark.covariance, landmark.covariance.diagonal(), repairs);
  const Eigen::Vector2d& place = landmark.mean;
  const PivotedRoot<3> root = pivoted_root<3>(belief.covariance, belief.covariance.diagonal(), repairs);
  const Eigen::Vector2d centre = predict_sighting(belief.mean, place);
  SigmaResiduals<2, 5> residuals = SigmaResiduals<2, 5>::Zero();  // beyond a rank points are the centre
  const auto look = [&](int dimension, const View& above, const View& below) {
    const Eigen::Matrix2d seen = predict_sightings(above, below);
    residuals.col(2 * dimension) = sighting_residual(seen.col(0), centre);
    residuals.col(2 * dimension + 1) = sighting_residual(seen.col(1), centre);
  };
  for (int i = 0; i < root.rank; ++i) {
    const Eigen::Vector3d step = five_.spread * root.lower.col(i);
    look(i, {boxplus(belief.mean, step), place}, {boxplus(belief.mean, -step), place});
  }
  for (int i = 0; i < spread.rank; ++i) {
    const Eigen::Vector2d step = five_.spread * spread.lower.col(i);
    look(3 + i, {belief.mean, place + step}, {belief.mean, place - step});
  }
  const Eigen::Vector2d mean = sigma_mean<2, 5>(residuals, five_);
  PredictedMeasurement predicted;
  predicted.expected = {centre.x() + mean.x(), wrap_angle(centre.y() + mean.y())};
  predicted.covariance =
      sigma_covariance<2, 5>(residuals, mean, five_) + noise_at(observation, predicted.expected);
  predicted.cross = sigma_cross<3, 2, 5>(root.lower, 0, residuals, five_);
  return predicted;
}

LandmarkBelief Unscented::refine(const LandmarkBelief& landmark, const Pose& robot,
                                 const Observation& observation, long& repairs) const {
  const Eigen::Matrix2d root = semidefinite_root<2>(landmark.covariance, repairs);
  const Eigen::Vector2d centre = predict_sighting(robot, landmark.mean);
  SigmaResiduals<2, 2> residuals;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = two_.spread * root.col(i);
    const Eigen::Matrix2d seen =
        predict_sightings({robot, landmark.mean + step}, {robot, landmark.mean - step});
    residuals.col(2 * i) = sighting_residual(seen.col(0), centre);
    residuals.col(2 * i + 1) = sighting_residual(seen.col(1), centre);
  }
  const Eigen::Vector2d mean = sigma_mean<2, 2>(residuals, two_);
  const Eigen::Matrix2d cross = sigma_cross<2, 2, 2>(root, 0, residuals, two_);
  const Eigen::Vector2d expected = centre + mean;
  const long before = repairs;
  const Factor2 factor(sigma_covariance<2, 2>(residuals, mean, two_) + noise_at(observation, expected),
                       repairs);
  if (repairs != before) return landmark;  // neither is uncertain: nothing can be learnt
  const Eigen::Matrix2d gain = factor.divide<2>(cross);
  const Eigen::Vector2d innovation = sighting_residual(observation.range_bearing, expected);
  const Eigen::Matrix2d covariance = landmark.covariance - gain * cross.transpose();
  return {landmark.mean + gain * innovation, 0.5 * (covariance + covariance.transpose())};
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
