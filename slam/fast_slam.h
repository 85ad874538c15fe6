/// The Rao-Blackwellised filter: particles carry paths, each with a map of Gaussians given its path.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "slam/association.h"
#include "slam/belief.h"
#include "slam/filter_config.h"
#include "slam/linearised.h"
#include "slam/random.h"
#include "slam/unscented.h"

namespace stereobench::slam {

/// FastSLAM with the optimal proposal, for any model of moments.
///
/// FastSLAM 2.0 and UFastSLAM are this one filter. They differ in Model only: how moments go through a control,
/// what a landmark should look like from an uncertain pose, and how a landmark is refined and found.
///
/// Each update draws every particle's pose once, which leaves it without uncertainty; until the next update all
/// particles are given the same controls. Motion in the plane does not depend on where it happens, so the motion
/// since the last update, its mean and covariance in the robot's frame, is predicted once for all particles and
/// put behind each particle's pose when something is seen. A prediction costs the same for 1 particle and 1000. A
/// frame in which nothing is seen leaves that motion to grow.
///
/// An update, for each particle: sightings of known landmarks are used one after the other, each with moments of
/// the belief that the one before left; the weight is multiplied by N(innovation; 0, S) with S from before the
/// landmark is used (by the chain rule this is the likelihood of the whole frame). Then particles are resampled if
/// need be - the weights depend on nothing that is drawn later, so that copies can still draw poses of their own -
/// and then each draws its pose, refines the landmarks it saw and adds new ones.
template <class Model>
class FastSlam {
 public:
  FastSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;

 private:
  struct Sighting {
    Observation observation;
    int slot = kUnknown;  ///< index of a known landmark; kUnknown when only its colour is known
    int colour_class = kUnknown;
  };
  struct Particle {
    Pose pose;                           ///< as drawn at the last update
    std::vector<LandmarkBelief> known;   ///< by slot, the same in all particles
    std::vector<ClassedLandmark> classed;  ///< in order of discovery, each particle has its own
  };
  /// A particle's pose after what it saw, before it is drawn.
  struct Posterior {
    PoseBelief pose;
    double log_likelihood = 0.0;
    bool used_something = false;
  };

  std::vector<Sighting> read(std::span<const RangeBearing> sightings);
  int slot_for(const RangeBearing& sighting);
  Posterior correct(const Particle& particle, std::span<const Sighting> frame, int* targets);
  void associate(const Particle& particle, const PoseBelief& belief, std::span<const Sighting> frame, int* targets);
  bool use(const LandmarkBelief& landmark, const Observation& observation, bool surely, Posterior& posterior);
  void reweigh();
  void resample();
  void redraw_map(std::size_t particle, std::span<const Sighting> frame);
  void add_classed(Particle& particle, const Sighting& sighting);
  std::size_t heaviest() const;
  LandmarkEstimate mixed_known(std::size_t slot) const;
  LandmarkEstimate mixed_classed(std::size_t landmark) const;

  FilterConfig config_;
  Model model_;
  RandomStream random_;
  double gate_;
  std::vector<Particle> particles_;
  std::vector<double> log_weights_;
  std::vector<Posterior> posteriors_;
  std::vector<int> targets_;  ///< particle by particle, one per sighting of the frame
  std::map<int, int> slot_of_id_;
  std::vector<RangeBearing> first_sightings_;  ///< by slot: identity and colour of known landmarks
  PoseBelief motion_;                          ///< since the last update, in the robot's frame of that time
  PoseBelief belief_;                          ///< at the last update, over all particles
  double effective_ = 1.0;
  FilterCounters counters_;
};

extern template class FastSlam<Linearised>;
extern template class FastSlam<Unscented>;

using FastSlam2 = FastSlam<Linearised>;
using UFastSlam = FastSlam<Unscented>;

}  // namespace stereobench::slam
