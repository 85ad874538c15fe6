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

/// A pair is loose where another landmark may be as near to the sighting with 10 %: minus twice the log.
inline constexpr double kLoose = 4.6;

/// The pairs of a sighting with the landmarks that it may be of: those within the gate that are likelier than
/// a landmark that is new, and those so near that they exclude a new one.
///
/// @param frame and the index of the sighting in it
/// @param candidates receives them at its end
template <class Belief>
void find_candidates(const AssociationPolicy& policy, const Belief& belief, std::span<const Sighting> frame,
                     std::size_t index, std::vector<Candidate>& candidates) {
  const Sighting& sighting = frame[index];
  const Observation& observation = sighting.observation;
  const SightingPlace place(belief.pose(), observation, {policy.gate, policy.near_m});
  const double cost_of_new = policy.existence.cost_of_new(observation);
  const double least_loose = policy.existence.cost_of_other(observation, frame.size()) - kLoose;
  visit_alike(belief, sighting, place, [&](std::size_t j, const Landmark& landmark) {
    const Misfit misfit = belief.misfit(j, landmark, observation);
    const bool gated = !(misfit.squared_length <= policy.gate && misfit.cost <= cost_of_new);
    if (gated && !((place.mean_m() - landmark.belief.mean).norm() < policy.near_m)) return;
    const bool loose = misfit.cost - misfit.squared_length > least_loose;
    candidates.push_back({static_cast<int>(index), static_cast<int>(j), misfit.cost, gated, loose});
  });
}

/// What the sightings of a frame cost that are of none of their candidates.
///
/// @param merges whether there can be such; if not, the largest set is always the likeliest
std::vector<double> costs_of_others(const AssociationPolicy& policy, bool merges,
                                    std::span<const Sighting> frame);

/// Takes from sightings that have a candidate which is not loose those that are: where it was last seen a
/// landmark is known best.
void drop_loose(std::vector<Candidate>& candidates);

/// Gives the sightings of a frame to landmarks: those with an identity to its landmark, the others to one of
/// their colour class (all that have none are one class), jointly where they compete.
///
/// @param belief where the robot and the landmarks should be, which offers
///   - `PoseBelief pose()`
///   - `int landmark_of(int slot)`: kUnknown for an identity that was not seen before
///   - `visit(may_matter, visit)`: the landmarks without an identity, as LandmarkMap::visit; it may ignore
///     what cannot matter, and need not
///   - `Misfit misfit(std::size_t j, const Landmark&, const Observation&)`
///   - `kTiesLandmarks`: whether it knows what the errors of landmarks have in common
///   - `JointInnovations innovations(std::span<const Candidate>, std::span<const Sighting> frame)`
/// @param targets one for each sighting; becomes kUse with its landmark, kAdd, kIgnore or kDouble
/// @param cut incremented when a joint association took too many steps
template <class Belief>
void associate(const AssociationPolicy& policy, const Belief& belief, std::span<const Sighting> frame,
               std::span<Target> targets, long& cut) {
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    targets[k] = {};
    if (frame[k].slot == kUnknown) {
      candidates.reserve(frame.size());
      find_candidates(policy, belief, frame, k, candidates);
    } else if (const int landmark = belief.landmark_of(frame[k].slot); landmark >= 0) {
      targets[k] = {Outcome::kUse, landmark};
    }
  }
  if (Belief::kTiesLandmarks && policy.merges) drop_loose(candidates);
  if (policy.association == Association::kJoint && !policy.near_excludes() && is_open(candidates)) {
    const auto [pairings, tie] = belief.innovations(candidates, frame);
    const bool merges = Belief::kTiesLandmarks && policy.merges;
    const std::vector<double> as_other = costs_of_others(policy, merges, frame);
    for (const int unsure : keep_joint(candidates, pairings, tie, as_other, policy.gate_probability, cut)) {
      if (!merges) continue;
      std::erase_if(candidates, [&](const Candidate& pair) { return pair.sighting == unsure; });
      targets[static_cast<std::size_t>(unsure)].outcome = Outcome::kDouble;
    }
  }
  assign(candidates, policy.near_excludes(), targets);
}

}  // namespace stereobench::slam
