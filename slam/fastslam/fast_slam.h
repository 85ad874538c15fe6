/// The Rao-Blackwellised filter: particles carry paths, each with a map of Gaussians given its path.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/decisions.h"
#include "slam/association/frame_reader.h"
#include "slam/association/map_management.h"
#include "slam/fastslam/particle.h"
#include "slam/fastslam/pose_correction.h"
#include "slam/fastslam/predictive_mixture.h"
#include "slam/filter_config.h"
#include "slam/math/random.h"
#include "slam/models/belief.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// What a particle's pose is drawn from.
enum class Proposal {
  kMotion,     ///< the odometry alone, before the frame is looked at: FastSLAM 1.0
  kPosterior,  ///< odometry and frame together: FastSLAM 2.0 and UFastSLAM
};

/// FastSLAM for any model of moments and either proposal.
///
/// FastSLAM 2.0 and UFastSLAM differ in Model only: how moments go through a control, what a landmark should
/// look like from an uncertain pose, and how a landmark is refined and found. FastSLAM 1.0 (Montemerlo et
/// al., AAAI 2002) is the same filter again, with poses drawn before they are corrected: a drawn pose has no
/// covariance, so sightings do not move it, and what they should look like is uncertain by landmark and
/// sensor alone, S = H Sigma H' + R.
///
/// Each update draws every particle's pose once, which leaves it without uncertainty; until the next update
/// all particles are given the same controls. Motion in the plane does not depend on where it happens, so the
/// motion since the last update, its mean and covariance in the robot's frame, is predicted once for all
/// particles and put behind each particle's pose when something is seen. A prediction costs the same for 1
/// particle and 1000. A frame in which nothing is seen, or nothing believed, leaves that motion to grow.
///
/// An update corrects each particle's pose by the landmarks it knows (PoseCorrection), resamples if need be,
/// draws the poses, and then refines the landmarks that were seen and adds new ones, given the pose drawn.
/// With the posterior as proposal the weights depend on nothing that is drawn in the update, so resampling
/// can go first: copies then draw poses of their own. With FastSLAM 1.0 copies part at the next control.
template <class Model>
class FastSlam {
 public:
  FastSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed,
           Proposal proposal = Proposal::kPosterior, Updates updates = Updates::kOneByOne);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;
  const UpdateReport& last_update() const { return report_; }
  int particle_count() const { return static_cast<int>(particles_.size()); }

  /// @return what the particle that the last frame left heaviest made of it
  Decisions last_decisions() const;

 private:
  std::span<Target> targets_of(std::size_t particle);
  void keep_expected(std::size_t particle);
  bool correct(std::span<const Sighting> frame);
  void draw_from_motion(std::span<const Sighting> frame);
  void reweigh();
  void note_decisions(std::span<const Sighting> frame);
  void resample();
  void draw_poses();
  Eigen::Vector3d normals();
  void update_map(std::size_t particle, std::span<const Sighting> frame);

  FilterConfig config_;
  Proposal proposal_;
  Updates updates_;
  Model model_;
  FrameReader reader_;
  PoseCorrection<Model> correction_;
  MapManagement management_;
  RandomStream random_;
  std::vector<Particle> particles_;
  std::vector<double> log_weights_;         ///< normalised
  std::vector<double> weights_;             ///< the same, not as logarithms
  std::vector<SineCosine> headings_;        ///< before the update in progress, by particle
  std::vector<Posterior> posteriors_;       ///< of the update in progress, by particle
  std::vector<Target> targets_;             ///< of the update in progress, particle by particle
  std::vector<ExpectedSighting> expected_;  ///< the same, for a report
  PoseBelief motion_;                       ///< since the last update, in the robot's frame of that time
  PoseBelief belief_;                       ///< at the last update, over all particles
  double effective_;
  std::size_t decider_ = 0;        ///< the particle that the last frame left heaviest
  std::vector<Decision> decided_;  ///< what it made of that frame
  FilterCounters counters_;
  UpdateReport report_;  ///< of the last update
};

extern template class FastSlam<Linearised>;
extern template class FastSlam<Unscented>;

using LinearisedFastSlam = FastSlam<Linearised>;
using UnscentedFastSlam = FastSlam<Unscented>;

}  // namespace stereobench::slam
