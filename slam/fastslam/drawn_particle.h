/// A particle whose pose is drawn, with what a frame changes in its map.
#pragma once

#include <vector>

#include "slam/association/map_management.h"
#include "slam/fastslam/particle.h"
#include "slam/math/gaussian.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {

/// A particle's map as MapManagement reads and writes it.
template <class Model>
struct DrawnParticle {
  static constexpr bool kClaimsLookalikes = false;
  Particle& particle;
  const Model& model;
  const Existence& existence;
  long& repairs;  ///< counts covariances that had to be repaired

  PoseBelief pose() const { return {particle.pose}; }
  int landmark_of(int slot) const { return slot_in(particle, slot); }

  template <class MayMatter, class Visit>
  void visit(const MayMatter& may_matter, const Visit& visit) const {
    particle.classed.visit(may_matter, visit);
  }

  Misfit misfit(std::size_t, const Landmark& landmark, const Observation& observation) const {
    long repaired = 0;  // for a comparison only
    const PredictedMeasurement seen =
        Linearised().expect(particle.pose, landmark.belief, observation, repaired);
    const Factor2 factor(seen.covariance, repaired);
    const double squared_length =
        factor.squared_length(sighting_residual(observation.range_bearing, seen.expected));
    return {squared_length, squared_length + factor.log_det_2_pi()};
  }

  const LandmarkBelief& seen_from_robot(std::size_t, const Landmark& landmark) const {
    return landmark.belief;
  }

  LandmarkBelief found(const Observation& observation) const {
    return model.found(particle.pose, observation, repairs);
  }

  void see_again(int landmark, const Sighting& sighting) { learn(sighting, {Outcome::kUse, landmark}); }

  int add(const Sighting& sighting, const Landmark& landmark, std::vector<int>& vacant) {
    LandmarkMap& map = map_of(particle, sighting);
    if (sighting.slot != kUnknown || vacant.empty()) {
      map.push_back(landmark);
      return static_cast<int>(map.size()) - 1;
    }
    const int place = vacant.back();
    vacant.pop_back();
    map.replace(static_cast<std::size_t>(place), landmark);
    return place;
  }

  void set_log_odds(std::size_t j, float log_odds) {
    Landmark landmark = particle.classed[j];
    landmark.status.log_odds = log_odds;
    particle.classed.replace(j, landmark);
  }

  /// Refines the landmark of a target, finds it anew, or notes that it was contradicted.
  void learn(const Sighting& sighting, const Target& target) {
    Landmark landmark = slam::landmark_of(particle, sighting, target);
    if (target.outcome == Outcome::kMove) {
      landmark.belief = found(sighting.observation);
    } else if (target.outcome != Outcome::kRefuse) {
      landmark.belief = model.refine(landmark.belief, particle.pose, sighting.observation, repairs);
    }
    note_sighting(landmark.status, sighting, target.outcome, existence);
    map_of(particle, sighting).replace(static_cast<std::size_t>(target.landmark), landmark);
  }
};

}  // namespace stereobench::slam
