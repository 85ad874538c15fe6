#include "slam/block_path.h"

#include "slam/gaussian.h"
#include "slam/measurement.h"

namespace stereobench::slam {
namespace {

/// @param variances of which the belief's covariance is what is left
Pose draw_one(const PoseBelief& belief, const Eigen::Vector3d& variances, RandomStream& random,
              long& repairs) {
  const PivotedRoot<3> root = pivoted_root<3>(belief.covariance, variances, repairs);
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = random.normal();
  return displace(belief.mean, root.lower * normals);
}

/// What is believed of a pose once the next one is known.
PoseBelief given_next(const PoseBelief& belief, const PoseBelief& predicted, const Pose& next) {
  constexpr double kVanishing = 1e-10;
  const Eigen::Vector2d turn = lever(belief.mean, {predicted.mean.x_m, predicted.mean.y_m}).col(2);
  PoseBelief given = belief;
  Eigen::Matrix3d shared = belief.covariance;  // with the next pose: P F'
  shared.col(0) += turn.x() * belief.covariance.col(2);
  shared.col(1) += turn.y() * belief.covariance.col(2);
  Eigen::Matrix3d ahead = predicted.covariance;
  Eigen::Vector3d unexplained = displacement(next, predicted.mean);
  Eigen::Vector3d learnt = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double variance = ahead(i, i);
    if (!(variance > kVanishing * predicted.covariance(i, i))) continue;
    const Eigen::Vector3d with_seen = shared.col(i);
    const Eigen::Vector3d gain = with_seen / variance;
    const double seen = unexplained[i];
    learnt += gain * seen;
    given.covariance -= gain * with_seen.transpose();
    for (int j = i + 1; j < 3; ++j) {
      const double share = ahead(i, j) / variance;
      unexplained[j] -= share * seen;
      shared.col(j) -= share * with_seen;
      for (int k = i + 1; k < 3; ++k) ahead(j, k) -= share * ahead(i, k);
    }
  }
  given.mean = displace(belief.mean, learnt);
  return given;
}

}  // namespace

template <class Model>
void PathSampler<Model>::correct(PoseBelief& belief, const PlacedSighting& seen, long& repairs) const {
  const Innovation expected = model_.expect(belief, seen.place, seen.observation, repairs);
  const long mended = repairs;
  const Factor2 factor(expected.covariance, repairs);
  if (repairs != mended) return;  // all is certain: nothing is learnt
  const Eigen::Matrix<double, 3, 2> gain = factor.divide<3>(expected.cross);
  const Eigen::Vector3d step = gain * sighting_residual(seen.observation.range_bearing, expected.expected);
  const Eigen::Matrix3d covariance = belief.covariance - gain * expected.cross.transpose();
  if (!step.allFinite() || !covariance.allFinite()) {
    ++repairs;
    return;
  }
  belief.mean = displace(belief.mean, step);
  belief.covariance = 0.5 * (covariance + covariance.transpose());
}

template <class Model>
void PathSampler<Model>::filter(const Pose& start, std::span<const PathStep> steps, long& repairs) {
  filtered_.clear();
  PoseBelief now{start};
  for (const PathStep& step : steps) {
    now = follow(now, step.motion);
    const PoseBelief before = now;
    for (const PlacedSighting& seen : step.seen) correct(now, seen, repairs);
    filtered_.push_back({before, now});
  }
}

template <class Model>
std::span<const Pose> PathSampler<Model>::draw(const Pose& start, std::span<const PathStep> steps,
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
