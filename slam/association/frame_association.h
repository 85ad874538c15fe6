/// Which landmarks a frame shows: one rule for every filter, whatever its belief is.
#pragma once

#include <span>
#include <vector>

#include "slam/association/association.h"
#include "slam/association/joint_compatibility.h"
#include "slam/association/landmark_search.h"
#include "slam/association/policy.h"

namespace stereobench::slam {

/// How badly a sighting fits a landmark.
struct Misfit {
  double squared_length = 0.0;  ///< of the innovation: squared Mahalanobis
  double cost = 0.0;            ///< minus twice the log likelihood
};

/// The innovations of candidates, and the covariances between them.
struct JointInnovations {
  std::vector<Pairing> pairings;  ///< one for each candidate, in their order
  Tie tie;
};

/// The pairs of a sighting with the landmarks that it may be of: those within the gate that are likelier than
/// a landmark that is new, and those so near that they exclude a new one.
///
/// @param index of the sighting in its frame
/// @param candidates receives them at its end
template <class Belief>
void find_candidates(const AssociationPolicy& policy, const Belief& belief, const Sighting& sighting,
                     int index, std::vector<Candidate>& candidates) {
  const Observation& observation = sighting.observation;
  const SightingPlace place(belief.pose(), observation, {policy.gate, policy.near_m});
  const double cost_of_new = policy.existence.cost_of_new(observation);
  visit_alike(belief, sighting, place, [&](std::size_t j, const Landmark& landmark) {
    const Misfit misfit = belief.misfit(j, landmark, observation);
    const bool gated = !(misfit.squared_length <= policy.gate && misfit.cost <= cost_of_new);
    if (gated && !((place.mean_m() - landmark.belief.mean).norm() < policy.near_m)) return;
    candidates.push_back({index, static_cast<int>(j), misfit.cost, gated});
  });
}

/// Gives the sightings of a frame to landmarks: those with an identity to its landmark, the others to one of
/// their colour class (all that have none are one class), jointly where they compete.
///
/// @param belief where the robot and the landmarks should be, which offers
///   - `PoseBelief pose()`
///   - `int landmark_of(int slot)`: kUnknown for an identity that was not seen before
///   - `visit(may_matter, visit)`: the landmarks without an identity, as LandmarkMap::visit; it may ignore
///     what cannot matter, and need not
///   - `Misfit misfit(std::size_t j, const Landmark&, const Observation&)`
///   - `JointInnovations innovations(std::span<const Candidate>, std::span<const Sighting> frame)`
/// @param targets one for each sighting; becomes kUse with its landmark, kAdd or kIgnore
/// @param cut incremented when a joint association took too many steps
template <class Belief>
void associate(const AssociationPolicy& policy, const Belief& belief, std::span<const Sighting> frame,
               std::span<Target> targets, long& cut) {
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    targets[k] = {};
    if (frame[k].slot == kUnknown) {
      candidates.reserve(frame.size());
      find_candidates(policy, belief, frame[k], static_cast<int>(k), candidates);
    } else if (const int landmark = belief.landmark_of(frame[k].slot); landmark >= 0) {
      targets[k] = {Outcome::kUse, landmark};
    }
  }
  if (policy.association == Association::kJoint && !policy.near_excludes() && compete(candidates)) {
    const auto [pairings, tie] = belief.innovations(candidates, frame);
    keep_joint(candidates, pairings, tie, policy.gate_probability, cut);
  }
  assign(candidates, policy.near_excludes(), targets);
}

}  // namespace stereobench::slam
