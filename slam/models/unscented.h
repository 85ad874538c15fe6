/// The model of UFastSLAM: moments through sigma points.
#pragma once

#include "slam/filter_config.h"
#include "slam/math/gaussian.h"
#include "slam/math/sigma_points.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// Unscented moments.
///
/// The paper augments the pose by control noise and measurement noise, N = 7. Measurement noise is additive,
/// so its sigma points only add R to the covariance; control noise acts in the motion only. Five dimensions
/// of pose and control noise in the motion, and five of pose and landmark in the measurement with R added,
/// say the same.
class Unscented {
 public:
  explicit Unscented(const UnscentedParameters& parameters = {}) : five_(parameters), two_(parameters) {}

  /// The pose after a control: sigma points over (pose, control noise), eq. 10-13.
  PoseBelief move(const PoseBelief& belief, const Control& control, const Eigen::Vector2d& control_sd,
                  long& repairs) const;

  /// What a landmark should look like: sigma points over (pose, landmark), drawn from the belief it is given,
  /// which is the updated one for every landmark after the first (eq. 17-20 and 24).
  PredictedMeasurement expect(const PoseBelief& belief, const LandmarkBelief& landmark,
                              const Observation& observation, long& repairs) const;

  /// The same from a pose that is known.
  PredictedMeasurement expect(const Pose& robot, const LandmarkBelief& landmark,
                              const Observation& observation, long& repairs) const {
    return expect(PoseBelief{robot}, landmark, observation, repairs);
  }

  /// The landmark after a sighting from a known pose: sigma points over the landmark (eq. 28-34).
  LandmarkBelief refine(const LandmarkBelief& landmark, const Pose& robot, const Observation& observation,
                        long& repairs) const;

  /// A landmark seen for the first time from a known pose: sigma points over the sighting (eq. 25-27).
  LandmarkBelief found(const Pose& robot, const Observation& observation, long& repairs) const;

  const SigmaWeights<5>& weights() const { return five_; }  ///< of points over five dimensions

 private:
  SigmaWeights<5> five_;
  SigmaWeights<2> two_;
};

}  // namespace stereobench::slam
