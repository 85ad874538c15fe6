#include "slam/block_path.h"

#include "slam/gaussian.h"
#include "slam/linearised.h"
#include "slam/measurement.h"
#include "slam/unscented.h"

namespace stereobench::slam {
namespace {

/// The filter's belief before and after the sightings of a step.
struct FilteredStep {
  PoseBelief before;
  PoseBelief after;
};

template <class Model>
void correct(const Model& model, PoseBelief& belief, const PlacedSighting& seen, long& repairs) {
  const LandmarkBelief landmark{seen.place, Eigen::Matrix2d::Zero()};
  const Innovation expected = model.expect(belief, landmark, seen.observation, repairs);
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
std::vector<FilteredStep> filter(const Model& model, const Pose& start, std::span<const PathStep> steps,
                                 long& repairs) {
  std::vector<FilteredStep> filtered;
  filtered.reserve(steps.size());
  PoseBelief now{start};
  for (const PathStep& step : steps) {
    now = follow(now, step.motion);
    const PoseBelief before = now;
    for (const PlacedSighting& seen : step.seen) correct(model, now, seen, repairs);
    filtered.push_back({before, now});
  }
  return filtered;
}

/// What is believed of a pose once the next one is known.
PoseBelief given_next(const PoseBelief& belief, const PoseBelief& predicted, const Pose& next) {
  constexpr double kVanishing = 1e-10;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  slope.topRows<2>() = lever(belief.mean, {predicted.mean.x_m, predicted.mean.y_m});
  Eigen::Matrix<double, 6, 6> joint;
  joint << belief.covariance, belief.covariance * slope.transpose(), slope * belief.covariance,
      predicted.covariance;
  Eigen::Matrix<double, 6, 1> off;  // what has been learnt of the pose; what of the next is still unexplained
  off << Eigen::Vector3d::Zero(), displacement(next, predicted.mean);
  for (int i = 3; i < 6; ++i) {
    const double variance = joint(i, i);
    if (!(variance > kVanishing * predicted.covariance(i - 3, i - 3))) continue;
    const Eigen::Matrix<double, 6, 1> gain = joint.col(i) / variance;
    const double seen = off[i];
    off.head<3>() += gain.head<3>() * seen;
    off.tail<3>() -= gain.tail<3>() * seen;
    joint -= gain * joint.row(i).eval();
  }
  const Eigen::Matrix3d rest = joint.topLeftCorner<3, 3>();
  return {displace(belief.mean, off.head<3>()), 0.5 * (rest + rest.transpose())};
}

Pose draw(const PoseBelief& belief, RandomStream& random, long& repairs) {
  const Eigen::Matrix3d root = semidefinite_root<3>(belief.covariance, repairs);
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = random.normal();
  return displace(belief.mean, root * normals);
}

}  // namespace

template <class Model>
std::vector<Pose> draw_path(const Model& model, const Pose& start, std::span<const PathStep> steps,
                            RandomStream& random, long& repairs) {
  const std::vector<FilteredStep> filtered = filter(model, start, steps, repairs);
  std::vector<Pose> path(steps.size());
  for (std::size_t k = steps.size(); k-- > 0;) {
    const bool last = k + 1 == steps.size();
    const PoseBelief& after = filtered[k].after;
    path[k] = draw(last ? after : given_next(after, filtered[k + 1].before, path[k + 1]), random, repairs);
  }
  return path;
}

template std::vector<Pose> draw_path(const Linearised& model, const Pose& start,
                                     std::span<const PathStep> steps, RandomStream& random, long& repairs);
template std::vector<Pose> draw_path(const Unscented& model, const Pose& start,
                                     std::span<const PathStep> steps, RandomStream& random, long& repairs);

}  // namespace stereobench::slam
