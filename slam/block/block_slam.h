/// FastSLAM 2.0 and UFastSLAM that draw the poses of many frames together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/decisions.h"
#include "slam/association/frame_reader.h"
#include "slam/block/path_draw.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/fastslam/particle.h"
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
/// frames goes by before anything is drawn. With s the block's first instant, a particle is a path x_0..s and
/// the map given that path, p(m | x_0..s, z_1..s) = product of Gaussians.
///
/// **Within a block** each particle is an iterated EKF over its pose and the landmarks that the block shows,
///     p(x_t, m | x_0..s, z_1..t),
/// which starts from the pose x_s without uncertainty and landmarks that are independent of each other. So
/// gate, association, contradictions and map management are those of EkfSlam. A frame is worth its
/// likelihood, to first order at its mode,
///     log w += log N(z; z^, S),  S = H P H' + R,
/// so that after K frames the weight has grown by p(z_s+1..t | x_0..s, z_1..s): the poses since s are
/// integrated out, and nothing that is drawn later makes weights scatter. The estimate is the mixture of
/// these Gaussians. Resampling copies them.
///
/// **At its end** x_s+1..t is drawn from p(x_s+1..t | x_0..s, z_1..t), in two steps: landmarks from their
/// joint Gaussian, m ~ N, and then the path given them (draw_path). The landmarks that were drawn are
/// forgotten, and those of the map at s are refined by the block's sightings from the poses drawn, as in
/// FastSLAM: given the path they are independent again. Where motion and sightings are linear this is exact,
/// for any K, but for a landmark that is found anew within a block: what it had said of the pose stays.
///
/// Until something is drawn all particles are alike, and one stands for them.
///
/// **A block ends** where the heading is so uncertain that the straight way from its start may be bent by a
/// good part of what a range tells. After a draw the heading is taken for exact, so that the next block
/// starts straight. A block also ends with its hundredth landmark, since a frame costs s n^2 + s^3 for s
/// sightings and a block's n landmarks, and after FilterConfig::draw_every frames. Landmarks without an
/// identity count where a sighting may be of them, or where they should be seen.
class BlockSlam {
 public:
  /// @param linearisation of a block's frames and landmarks: kIterated, or kSigmaPoints, which is better
  /// where bearings are poor
  BlockSlam(const FilterConfig& config, const Pose& start, std::uint64_t seed, Linearisation linearisation);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;
  const UpdateReport& last_update() const { return report_; }
  int particle_count() const { return config_.particles; }

  /// @return what the particle that the last frame left heaviest made of it
  Decisions last_decisions() const;

 private:
  static constexpr std::size_t kMostLandmarks = 100;  ///< of a block

  /// A landmark that a particle's block shows, beside what its EKF says of it.
  struct Shown {
    int in_map = kUnknown;  ///< its index in the particle's map; none where the block has found it
    int origin = kUnknown;  ///< the sighting that founded it
    bool is_new = true;     ///< whether what was known before the block is of no use
  };

  /// A particle: where its path and map stood when the block began, and what has been learnt since.
  struct Hypothesis {
    Particle start;
    EkfSlam now;
    std::vector<Shown> shown;  ///< by landmark of `now`
    std::vector<BlockFrame> frames;

    void descend_from(const Hypothesis& other);
  };

  void take_up_known(Hypothesis& mine, std::span<const Sighting> frame) const;
  void take_up_near(Hypothesis& mine, std::span<const Sighting> frame) const;
  static void take_up(Hypothesis& mine, int slot, const LandmarkMap& map, std::size_t index);
  void use(Hypothesis& mine, std::span<const Sighting> frame);
  static void note_founded(Hypothesis& mine);
  bool block_is_over() const;
  /// How many particles each hypothesis stands for.
  long particles_of_each() const { return config_.particles / static_cast<long>(hypotheses_.size()); }
  void multiply();
  double worth(const Hypothesis& mine, std::span<const Sighting> frame);
  void reweigh(std::span<const Sighting> frame);
  void resample();
  void draw_block(Hypothesis& mine);
  std::vector<LandmarkBelief> learn(const Hypothesis& mine, std::span<const Pose> path);
  static void write_back(const Hypothesis& mine, std::span<const LandmarkBelief> learnt, Particle& particle);
  static Particle present(const Hypothesis& mine);
  std::size_t heaviest() const;

  FilterConfig config_;
  AssociationPolicy policy_;
  bool by_sigma_points_;
  Linearised linearised_;
  Unscented unscented_;
  FrameReader reader_;
  RandomStream random_;
  std::vector<Hypothesis> hypotheses_;  ///< one before the first draw, then all particles
  std::vector<double> log_weights_;     ///< normalised
  std::vector<double> weights_;         ///< the same, not as logarithms
  PoseBelief motion_;                   ///< since the last frame, in the robot's frame of that time
  PoseBelief belief_;                   ///< at the last frame, over all particles
  double effective_;
  std::size_t decider_ = 0;        ///< the particle that the last frame left heaviest, which resampling keeps
  std::vector<Decision> decided_;  ///< what it made of the frame
  FilterCounters counters_;
  UpdateReport report_;  ///< of the last update
};

}  // namespace stereobench::slam
