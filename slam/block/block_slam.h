/// FastSLAM 2.0 and UFastSLAM that draw the poses of many frames together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/decisions.h"
#include "slam/association/frame_reader.h"
#include "slam/block/backward_sampling.h"
#include "slam/ekf/joint_belief.h"
#include "slam/fastslam/particle.h"
#include "slam/fastslam/predictive_mixture.h"
#include "slam/filter_config.h"
#include "slam/math/random.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// Block sampling (Doucet, Briers and Senecal 2006; Beevers and Huang, ICRA 2007, for SLAM) with the block's
/// poses and landmarks as one Gaussian.
///
/// FastSLAM 2.0 draws a pose at each frame, knowing nothing of what is seen next; most of these draws turn
/// out wrong a few frames later, the weights scatter, and resampling leaves few paths. Here a block of K
/// frames (FilterConfig::draw_every) goes by before anything is drawn. With s the block's first instant, a
/// particle is a path x_0..s and the map given that path, p(m | x_0..s, z_1..s) = product of Gaussians.
///
/// **Within a block** each particle is a Kalman filter over its pose and the landmarks it has seen in this
/// block,
///     p(x_t, m | x_0..s, z_1..t),
/// which starts from the pose x_s without uncertainty and landmarks that are independent of each other. A
/// sighting is worth
///     log w += log N(z; z^, S),  S = [Hx Hm] P [Hx Hm]' + R,
/// so that after K frames the weight has grown by p(z_s+1..t | x_0..s, z_1..s): the poses since s are
/// integrated out, and nothing that is drawn later makes weights scatter. The estimate is the mixture of
/// these Gaussians. Resampling copies them.
///
/// **At its end** x_s+1..t is drawn from p(x_s+1..t | x_0..s, z_1..t), in two steps: landmarks from their
/// joint Gaussian, m ~ N, and then the path given them (PathSampler). The landmarks that were drawn are
/// forgotten, and those of the map at s are refined by the block's sightings from the poses drawn, as in
/// FastSLAM: given the path they are independent again. Where motion and sightings are linear this is exact,
/// for any K. Poor bearings are not: there the moments of the model are what a block costs, those by
/// Jacobians more than FastSLAM 2.0's own, which are taken anew at each pose drawn, and those by sigma points
/// about as much as the draws that they save.
///
/// @tparam Model Linearised, an EKF within a block, or Unscented
///
/// Sightings must have identities; others are refused and counted. A sighting beyond the gate corrects
/// nothing and costs its particle the likelihood at the gate; contradictions are not settled. A frame costs
/// n^2 in the n landmarks of a block, whatever the size of the map; a block that has a hundred of them ends
/// early.
template <class Model>
class BlockSlam {
 public:
  BlockSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;
  const UpdateReport& last_update() const { return report_; }
  int particle_count() const { return static_cast<int>(hypotheses_.size()); }

  /// @return what the particle that the last frame left heaviest made of it
  Decisions last_decisions() const;

 private:
  /// A particle: where its path and map stood when the block began, and what has been learnt since.
  struct Hypothesis {
    Particle start;
    JointBelief now;
    std::vector<Outcome> outcomes;  ///< of all sightings of the block

    void descend_from(const Hypothesis& other);
  };
  static constexpr std::size_t kMostLandmarks = 100;  ///< of a block
  struct Frame {
    PoseBelief motion;
    std::vector<Sighting> sightings;
  };

  bool is_mapped(int slot) const { return static_cast<std::size_t>(slot) < origins_.size(); }
  int& place_of(int slot) { return place_of_slot_[static_cast<std::size_t>(slot)]; }
  void enter(const Frame& frame);
  void absorb(const Frame& frame);
  double correct(Hypothesis& mine, const Frame& frame, std::span<Target> targets,
                 std::span<ExpectedSighting> expected);
  ExpectedSighting use(Hypothesis& mine, const Sighting& sighting, Target& target);
  void take_up(Hypothesis& mine, int slot);
  void add_new(Hypothesis& mine, const Frame& frame);
  void reweigh();
  std::size_t heaviest() const;
  void note_decisions(std::span<const Sighting> frame);
  void resample();
  void close_block();
  void draw_block(Hypothesis& mine);
  void place_sightings(const Hypothesis& mine);
  void learn(Hypothesis& mine, std::span<const Pose> path);
  LandmarkBelief landmark(const Hypothesis& of, std::size_t slot) const;

  FilterConfig config_;
  double gate_;
  Model model_;
  FrameReader reader_;
  RandomStream random_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<Frame> block_;         ///< since the poses were drawn
  std::vector<int> slots_of_block_;  ///< of the landmarks seen in it, by their place in the joint belief
  std::size_t known_in_block_ = 0;   ///< how many of them the map has, or had before the last frame
  std::vector<int> place_of_slot_;   ///< by slot: its index among the block's landmarks, or -1
  std::vector<double> worth_;        ///< of the last frame to each particle, as logarithms
  std::vector<double> log_weights_;  ///< normalised
  std::vector<double> weights_;      ///< the same, not as logarithms
  std::vector<Target> targets_;      ///< of the last frame, particle by particle
  std::vector<ExpectedSighting> expected_;  ///< the same, for a report
  std::vector<int> origins_;                ///< by slot: the sighting that founded the landmark
  JointCovariance::Columns whitened_;       ///< memory for corrections
  PathSampler<Model> sampler_;
  std::vector<BlockStep> steps_;  ///< the block as one particle sees it
  std::vector<Landmark> learnt_;  ///< of one particle, by place in the block
  std::vector<bool> has_learnt_;  ///< the same
  PoseBelief motion_;             ///< since the last frame, in the robot's frame of that time
  PoseBelief belief_;             ///< at the last frame, over all particles
  double effective_;
  std::vector<Decision> decided_;  ///< what the heaviest particle made of the last frame
  FilterCounters counters_;
  UpdateReport report_;  ///< of the last update
};

extern template class BlockSlam<Linearised>;
extern template class BlockSlam<Unscented>;

using LinearisedBlockSlam = BlockSlam<Linearised>;
using UnscentedBlockSlam = BlockSlam<Unscented>;

}  // namespace stereobench::slam
