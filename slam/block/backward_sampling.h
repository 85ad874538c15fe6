/// Drawing the poses of several frames together, where the landmarks that were seen are known.
#pragma once

#include <span>
#include <vector>

#include "slam/math/random.h"
#include "slam/models/belief.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"

namespace stereobench::slam {

/// A sighting of a landmark whose place is known.
struct PlacedSighting {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< in the world, m
  Observation observation;
};

/// How a robot came to a frame, and what it saw there.
struct BlockStep {
  PoseBelief motion;  ///< since the step before, in the robot's frame of that time
  std::vector<PlacedSighting> seen;
};

/// Draws paths from p(x_1..x_K | x_0, landmarks, sightings).
///
/// Given the landmarks, poses are a Markov chain. A Kalman filter leads through the steps,
///     x_k- = f(x_k-1, u_k),  P_k- = F P_k-1 F' + Q,  then K = P_k- H' S^-1 for each sighting,
/// and poses are drawn from the last one back (Carter and Kohn 1994): x_K from (x_K^, P_K), and x_k given
/// x_k+1 from the joint Gaussian of both,
///     [ P_k      P_k F' ]
///     [ F P_k    P_k+1- ].
/// It is conditioned on one coordinate after the other, and one that nothing is uncertain of teaches nothing:
/// the motion of a single control has rank two, and no P is inverted. Motions are taken to first order in the
/// heading; sightings as the model says, whose cross covariance stands for P H'.
///
/// @tparam Model Linearised or Unscented
template <class Model>
class PathSampler {
 public:
  explicit PathSampler(const UnscentedParameters& parameters = {}) : model_(parameters) {}

  /// @param start the pose before the first step, known
  /// @param repairs counts covariances that had to be repaired
  /// @return the pose at each step; valid until the next call
  std::span<const Pose> draw(const Pose& start, std::span<const BlockStep> steps, RandomStream& random,
                             long& repairs);

 private:
  /// The filter's belief before and after the sightings of a step.
  struct FilteredStep {
    PoseBelief before;
    PoseBelief after;
  };

  void filter(const Pose& start, std::span<const BlockStep> steps, long& repairs);
  void correct(PoseBelief& belief, const PlacedSighting& seen, long& repairs) const;

  Model model_;
  std::vector<FilteredStep> filtered_;
  std::vector<Pose> path_;
};

extern template class PathSampler<Linearised>;
extern template class PathSampler<Unscented>;

}  // namespace stereobench::slam
