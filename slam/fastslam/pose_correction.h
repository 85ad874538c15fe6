/// What one particle makes of one frame: which landmarks it saw, and where that puts it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam/association/policy.h"
#include "slam/fastslam/frame_fit.h"
#include "slam/fastslam/frame_update.h"
#include "slam/fastslam/particle.h"
#include "slam/fastslam/predictive_mixture.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"

namespace stereobench::slam {

/// From where the landmarks of a frame are looked at.
enum class Updates {
  kOneByOne,  ///< each from where the one before left the pose: the paper's refreshed sigma points (eq. 24)
  kAtOnce,  ///< all from the predicted pose, in one update: the code that Kim, Sakthivel and Chung published
  kIterated,  ///< all at once, linearised at the mode (fit_frame)
  kToJudge,   ///< one by one, but for their outcomes alone: the pose is drawn without them (FastSLAM 1.0)
};

/// Corrects the predicted pose of a particle by the landmarks it knows, one after the other, oldest first.
///
/// Each landmark's moments are taken from the belief that the one before left, and the particle's likelihood
/// is multiplied by N(innovation; 0, S) with S from before the landmark is used; never from the updated
/// covariance.
///
/// With Updates::kAtOnce the sightings within the gate of the prediction are used together (correct_at_once),
/// and those beyond it one after the other, from where that leaves the pose.
///
/// With Updates::kToJudge nobody reads the pose that a frame without contradictions leaves, so that what its
/// last landmark would make of the pose is not worked out.
///
/// With Updates::kIterated the frame is fitted as a whole (fit_frame). A sighting beyond the gate of what the
/// motion and all others say is left out of the fit, the worst first. What is left out is then held against
/// the pose of the fit, one after the other. So landmarks that agree on a pose overrule the odometry, and one
/// alone is refused.
///
/// **Contradictions.** A sighting that stays beyond the gate is refused: it moves nothing, and costs the
/// particle the likelihood at the gate, so that refusing neither pays nor kills. An outlier passes like that.
/// A landmark that is contradicted several times in a row is no outlier: either the pose or the landmark is
/// wrong. When an older landmark has corroborated the pose in this frame, or the landmark itself was seen
/// rarely, the landmark is found anew. Otherwise the pose has drifted, as at the end of a loop, and the
/// filter was too sure of it: the covariance grows by the smallest drift that explains the sighting, and the
/// sighting is used. Its likelihood falls with the square of that drift, so that particles which close the
/// loop best live on. Where the spacing of colours is known a single sighting settles whose it is, and no
/// patience is needed.
///
/// **Association.** Without an identity a sighting is held against the landmarks of its colour class (all
/// that have none are one class) within the gate, where they are likelier than a landmark that is new. A
/// sighting of nothing in the map costs the particle the density of new landmarks and clutter, where the
/// sensor says enough of itself to know it: else a particle could not be told apart from one that takes all
/// for new. So does one of a landmark that may be clutter; it corrects no pose.
template <class Model>
class PoseCorrection {
 public:
  explicit PoseCorrection(const FilterConfig& config, Updates updates = Updates::kOneByOne);

  /// @param particle its map, and its pose before the motion
  /// @param predicted where the particle should be by its odometry
  /// @param motion the same from the pose before, along and across its chord
  /// @param frame what was seen
  /// @param targets one for each sighting; receives its outcome
  Posterior correct(const Particle& particle, const PoseBelief& predicted, const ChordBelief& motion,
                    std::span<const Sighting> frame, std::span<Target> targets, FilterCounters& counters);

  /// The likelihood of the same frame from a pose that was drawn: each sighting that was used counts by its
  /// innovation's density given that pose, each that was refused by the likelihood at the gate.
  ///
  /// @param targets as decided by correct()
  double log_likelihood(const Particle& particle, const Pose& drawn, std::span<const Sighting> frame,
                        std::span<const Target> targets, long& repairs);

  /// What the particle of the last call expected of each sighting; empty unless the settings ask for reports.
  std::span<const ExpectedSighting> expected() const { return expected_; }

 private:
  /// What one sighting is looked at for, besides its outcome.
  struct Wanted {
    ExpectedSighting* expected = nullptr;  ///< receives what was expected; null where nobody asks
    bool pose = true;                      ///< whether anything reads the pose that the sighting leaves
  };

  void doubt(const Particle& particle, std::span<const Sighting> frame, std::span<Target> targets) const;
  double log_density_of_new(std::span<const Sighting> frame, std::span<const Target> targets) const;
  void use_at_once(const Particle& particle, std::span<const Sighting> frame, std::span<Target> targets,
                   Posterior& posterior, FilterCounters& counters);
  void fit_at_once(const Particle& particle, const ChordBelief& motion, std::span<const Sighting> frame,
                   std::span<Target> targets, Posterior& posterior, FilterCounters& counters);
  bool was_fitted_by_older(std::size_t sighting) const;
  Outcome use(const Landmark& landmark, const Sighting& sighting, Posterior& posterior,
              FilterCounters& counters, const Wanted& wanted) const;

  Model model_;
  Updates updates_;
  AssociationPolicy policy_;
  bool report_;
  std::vector<ExpectedSighting> expected_;
  std::vector<std::size_t> order_;
  std::vector<std::size_t> late_;             ///< of order_, what is used one after the other
  std::optional<std::size_t> oldest_fitted_;  ///< sighting of the oldest landmark in the fit of the frame
  std::vector<Expectation> expectations_;
  std::vector<Match> matches_;
};

extern template class PoseCorrection<Linearised>;
extern template class PoseCorrection<Unscented>;

}  // namespace stereobench::slam
