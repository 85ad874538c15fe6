/// What a sighting says of a joint belief: by Jacobians, or by sigma points.
#pragma once

#include "slam/ekf/joint_belief.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"

namespace stereobench::slam {

/// Looks for a landmark where it should be, by sigma points over pose and landmark with what ties them
/// together.
///
/// The slope is that of the straight line through the points, A = P_zx P^-1 (statistical linear regression;
/// Lefebvre, Bruyninckx and De Schutter 2002). All else is jointly Gaussian with pose and landmark, so that A
/// says what it shares with the sighting as well, and the correction is the linearised one's. S has what the
/// points are off that line beyond A P A' + R.
JointInnovation innovation(const Unscented& model, const JointBelief& belief, int landmark,
                           const Observation& observation, long& repairs);

/// Takes a landmark for what is seen from an uncertain pose.
///
/// @param landmark index of one that is forgotten, or one more than the last
/// @param repairs counts covariances that had to be repaired
void find(const Linearised& model, JointBelief& belief, int landmark, const Observation& observation,
          long& repairs);

/// The same by sigma points over pose and sighting.
void find(const Unscented& model, JointBelief& belief, int landmark, const Observation& observation,
          long& repairs);

}  // namespace stereobench::slam
