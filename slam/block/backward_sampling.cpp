#include "slam/block/backward_sampling.h"

#include <cmath>

#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

/// @param variances of which the belief's covariance is what is left
Pose draw_one(const PoseBelief& belief, const Eigen::Vector3d& variances, RandomStream& random,
              long& repairs) {
  const PivotedRoot<3> root = pivoted_root<3>(belief.covariance, variances, repairs);
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = random.normal();
  return boxplus(belief.mean, root.lower * normals);
}

/// What is believed of a pose once the next one is known.
PoseBelief given_next(const PoseBelief& belief, const PoseBelief& predicted, const Pose& next) {
  constexpr double kVanishing = 1e-10;
  const Eigen::Vector2d turn = heading_lever(belief.mean, {predicted.mean.x_m, predicted.mean.y_m});
  PoseBelief given = belief;
  Eigen::Matrix3d shared;  // with the next pose: P F'
  for (int j = 0; j < 2; ++j) shared.col(j) = belief.covariance.col(j) + turn[j] * belief.covariance.col(2);
  shared.col(2) = belief.covariance.col(2);
  Eigen::Matrix3d ahead = predicted.covariance;
  Eigen::Vector3d unexplained = boxminus(next, predicted.mean);
  Eigen::Vector3d learnt = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double variance = ahead(i, i);
    if (!(variance > kVanishing * predicted.covariance(i, i))) continue;
    const Eigen::Vector3d with_seen = shared.col(i);
    const Eigen::Vector3d gain = with_seen / variance;
    const double seen = unexplained[i];
    learnt += gain * seen;
    for (int j = 0; j < 3; ++j) given.covariance.col(j) -= gain * with_seen[j];
    for (int j = i + 1; j < 3; ++j) {
      const double share = ahead(i, j) / variance;
      unexplained[j] -= share * seen;
      shared.col(j) -= share * with_seen;
      for (int k = i + 1; k < 3; ++k) ahead(j, k) -= share * ahead(i, k);
    }
  }
  given.mean = boxplus(belief.mean, learnt);
  return given;
}

}  // namespace

template <class Model>
void PathSampler<Model>::correct(PoseBelief& belief, const PlacedSighting& seen, long& repairs) const {
  const PredictedMeasurement expected = model_.expect(belief, seen.place, seen.observation, repairs);
  const long before = repairs;
  const Factor2 factor(expected.covariance, repairs);
  if (repairs != before) return;  // all is certain: nothing is learnt

  // What the pose shares with the sighting, and the innovation.
  Eigen::Matrix<double, 4, 2> whitened;
  whitened.topRows<3>() = expected.cross;
  whitened.row(3) = sighting_residual(seen.observation.range_bearing, expected.expected).transpose();
  factor.whiten_in_place(whitened);
  if (!std::isfinite(whitened.squaredNorm() * whitened.row(3).squaredNorm())) {
    ++repairs;
    return;
  }
  const Eigen::Vector3d shared_range = whitened.col(0).head<3>();
  const Eigen::Vector3d shared_bearing = whitened.col(1).head<3>();
  belief.mean = boxplus(belief.mean, shared_range * whitened(3, 0) + shared_bearing * whitened(3, 1));
  for (int j = 0; j < 3; ++j)
    belief.covariance.col(j) -= shared_range * shared_range[j] + shared_bearing * shared_bearing[j];
}

template <class Model>
void PathSampler<Model>::filter(const Pose& start, std::span<const BlockStep> steps, long& repairs) {
  filtered_.resize(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    auto& [before, after] = filtered_[k];
    before = follow(k > 0 ? filtered_[k - 1].after : PoseBelief{start}, steps[k].motion);
    after = before;
    for (const PlacedSighting& seen : steps[k].seen) correct(after, seen, repairs);
  }
}

template <class Model>
std::span<const Pose> PathSampler<Model>::draw(const Pose& start, std::span<const BlockStep> steps,
                                               RandomStream& random, long& repairs) {
  filter(start, steps, repairs);
  path_.resize(steps.size());
  for (std::size_t k = steps.size(); k-- > 0;) {
    const PoseBelief& after = filtered_[k].after;
    const bool last = k + 1 == steps.size();
    const PoseBelief given = last ? after : given_next(after, filtered_[k + 1].before, path_[k + 1]);
    path_[k] = draw_one(given, after.covariance.diagonal(), random, repairs);
  }
  return path_;
}

template class PathSampler<Linearised>;
template class PathSampler<Unscented>;

}  // namespace stereobench::slam
