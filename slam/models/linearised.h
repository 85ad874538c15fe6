/// The model of FastSLAM 2.0: moments through Jacobians, evaluated anew for each landmark.
#pragma once

#include "slam/filter_config.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// First-order moments. Every Jacobian is taken where it is used, none is kept for the next landmark.
class Linearised {
 public:
  explicit Linearised(const UnscentedParameters& = {}) {}

  /// The pose after a control whose velocities have the given standard deviations (m/s, rad/s).
  PoseBelief move(const PoseBelief& belief, const Control& control, const Eigen::Vector2d& control_sd,
                  long& repairs) const;

  /// What a landmark should look like: S = Hx P Hx' + Hm Sigma Hm' + R, cross = P Hx'.
  PredictedMeasurement expect(const PoseBelief& belief, const LandmarkBelief& landmark,
                              const Observation& observation, long& repairs) const;

  /// The same from a pose that is known: S = Hm Sigma Hm' + R, and nothing to correct.
  PredictedMeasurement expect(const Pose& robot, const LandmarkBelief& landmark,
                              const Observation& observation, long& repairs) const;

  /// The landmark after a sighting from a known pose: the extended Kalman update.
  LandmarkBelief refine(const LandmarkBelief& landmark, const Pose& robot, const Observation& observation,
                        long& repairs) const;

  /// A landmark seen for the first time from a known pose: G R G' with G the Jacobian of locate().
  LandmarkBelief found(const Pose& robot, const Observation& observation, long& repairs) const;
};

}  // namespace stereobench::slam
