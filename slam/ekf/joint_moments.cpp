#include "slam/ekf/joint_moments.h"

#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// What two numbers are that depend on five, and how, to those who take it for a straight line.
struct LinearFit {
  Eigen::Vector2d mean;  ///< from the value at the input's mean
  Eigen::Matrix2d covariance;
  Eigen::Matrix<double, 2, 5> slope;  ///< zero where nothing is uncertain
};

/// @param off from the value at the input's mean, of that a step away and that as far on the other side
template <class Function>
LinearFit line_through(const Matrix5& covariance, const SigmaWeights<5>& weights, const Function& off,
                       long& repairs) {
  const PivotedRoot<5> root = pivoted_root<5>(covariance, covariance.diagonal(), repairs);
  SigmaResiduals<2, 5> residuals = SigmaResiduals<2, 5>::Zero();
  for (int i = 0; i < root.rank; ++i)
    residuals.middleCols<2>(2 * i) = off(weights.spread * root.lower.col(i));
  LinearFit line;
  line.mean = sigma_mean<2, 5>(residuals, weights);
  line.covariance = sigma_covariance<2, 5>(residuals, line.mean, weights);
  // With P = L L' the covariance with the input is L W', where W is that with independent coordinates:
  // A L = W, and L may be singular.
  Eigen::Matrix<double, 2, 5> with_independent;
  for (int i = 0; i < 5; ++i)
    with_independent.col(i) =
        weights.other * weights.spread * (residuals.col(2 * i) - residuals.col(2 * i + 1));
  line.slope = root.divide<2>(with_independent);
  return line;
}

}  // namespace

JointInnovation innovation(const Unscented& model, const JointBelief& belief, int landmark,
                           const Observation& observation, long& repairs) {
  const Eigen::Vector2d& place = belief.landmarks[static_cast<std::size_t>(landmark)];
  const Eigen::Vector2d apart(place.x() - belief.pose.x_m, place.y() - belief.pose.y_m);
  const Eigen::Vector2d centre = polar(apart);
  const auto off = [&](const Vector5& step) {
    const Eigen::Vector2d shift = step.tail<2>() - step.head<2>();
    Eigen::Matrix2d seen = polar(apart + shift, apart - shift).colwise() - centre;
    seen.row(1) << wrap_angle(seen(1, 0) - step[2]), wrap_angle(seen(1, 1) + step[2]);
    return seen;
  };
  const Matrix5 uncertain = belief.covariance.pose_and_landmark(landmark);
  const LinearFit line = line_through(uncertain, model.weights(), off, repairs);
  const Eigen::Vector2d expected(centre.x() + line.mean.x(),
                                 wrap_angle(centre.y() - belief.pose.heading_rad + line.mean.y()));
  const Eigen::Matrix2d covariance = line.covariance + noise_at(observation, expected);
  return {line.slope, line.slope * uncertain, covariance, Factor2(covariance, repairs),
          sighting_residual(observation.range_bearing, expected)};
}

void find(const Linearised& model, JointBelief& belief, int landmark, const Observation& observation,
          long& repairs) {
  place(belief, landmark, model.found(belief.pose, observation, repairs), repairs);
}

void find(const Unscented& model, JointBelief& belief, int landmark, const Observation& observation,
          long& repairs) {
  const Eigen::Matrix3d pose = belief.covariance.pose();
  Matrix5 covariance = Matrix5::Zero();
  covariance.topLeftCorner<3, 3>() = pose;
  covariance.bottomRightCorner<2, 2>() = noise_at(observation, observation.range_bearing);
  const Eigen::Vector2d centre = locate(belief.pose, observation.range_bearing);
  const auto found = [&](const Vector5& step) -> Eigen::Vector2d {
    return locate(boxplus(belief.pose, step.head<3>()), observation.range_bearing + step.tail<2>()) - centre;
  };
  const auto off = [&](const Vector5& step) {
    Eigen::Matrix2d both;
    both << found(step), found(-step);
    return both;
  };
  const LinearFit line = line_through(covariance, model.weights(), off, repairs);
  const Eigen::Matrix<double, 2, 3> by_pose = line.slope.leftCols<3>();
  if (static_cast<std::size_t>(landmark) == belief.landmarks.size()) belief.landmarks.emplace_back();
  belief.landmarks[static_cast<std::size_t>(landmark)] = centre + line.mean;
  belief.covariance.place(landmark, by_pose, line.covariance - by_pose * pose * by_pose.transpose(), repairs);
}

}  // namespace stereobench::slam
