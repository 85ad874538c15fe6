/// The extended Kalman filter over the pose and all landmarks at once.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "slam/association/decisions.h"
#include "slam/association/frame_reader.h"
#include "slam/association/map_management.h"
#include "slam/association/policy.h"
#include "slam/ekf/frame_mode.h"
#include "slam/ekf/joint_belief.h"
#include "slam/filter_config.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// Where an EKF linearises the motion and the sightings of a frame.
enum class Linearisation {
  kOnce,         ///< at what is predicted
  kIterated,     ///< at what explains the frame best, with the motion's error along and across its chord
  kSigmaPoints,  ///< the same; frames that bend little, and landmarks that are new, by sigma points
};

/// A sighting and the landmark that it was used for.
struct UsedSighting {
  int landmark = 0;  ///< index
  Observation observation;
};

/// EKF-SLAM (Smith, Self and Cheeseman, 1990): one Gaussian, in which the pose and every landmark are
/// correlated with each other.
///
/// The motion since the last update is kept apart, in the robot's frame, as FastSlam does: motion in the
/// plane does not depend on where it happens, and levers of motions add up, so putting it behind the pose in
/// one go is the same as step by step. A prediction then touches no landmark.
///
/// An update takes the landmarks one after the other, oldest first, each linearised where the one before left
/// the mean. Gate, association by colour and contradictions follow the rules of PoseCorrection, and what is
/// there and what is new those of MapManagement.
///
/// Where landmarks have no identities and the sensor's sector is declared, those that were found twice are
/// merged (find_doubles).
///
/// Iterated (Bell and Cathey, 1993), it finds the mode of a frame first (frame_mode), and leaves out the
/// sightings that all others speak against.
class EkfSlam {
 public:
  EkfSlam(const FilterConfig& config, const Pose& start, Linearisation linearisation = Linearisation::kOnce);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const;
  const UpdateReport& last_update() const { return report_; }
  int particle_count() const { return 1; }
  Decisions last_decisions() const;

  /// A landmark of the map beside its place.
  struct Mapped {
    int slot = kUnknown;
    LandmarkStatus status;
    int first_seen = 0;  ///< counted in frames
    int last_seen = 0;
  };

  // An update in parts, for an estimator that has beliefs of its own and reads its frames with this filter.

  /// @return those sightings that can be; the others are counted
  std::vector<Sighting> read(std::span<const RangeBearing> sightings);

  /// Forgets pose and map for others; the motion since the last update stays.
  void assume(JointBelief belief, std::vector<Mapped> map);

  /// Forgets pose and map for a pose that is known exactly, and keeps their memory.
  void start_anew(const Pose& pose);

  /// Adds a landmark that nothing ties to the pose or to other landmarks.
  void take_up(int slot, const Landmark& landmark);

  /// @return whether a landmark is sure enough to be part of an estimate
  static bool is_reported(const Mapped& landmark);

  /// @return what an estimate says of it
  LandmarkEstimate reported(const Mapped& landmark, const LandmarkBelief& belief) const;

  /// The rest of an update.
  void use(std::span<const Sighting> frame);

  /// The same where somebody else keeps the motion since the last update.
  void use(std::span<const Sighting> frame, const PoseBelief& motion);

  /// Makes one of landmarks that were found twice, however long ago; merged() then names these too.
  /// @param shown how many landmarks a look shows
  /// @return whether there were any
  bool merge_doubles(std::size_t shown) { return merge_doubles(frames_, shown); }

  const JointBelief& belief() const { return belief_; }    ///< at the last update
  const PoseBelief& motion() const { return motion_; }     ///< since then, in the robot's frame of that time
  const std::vector<Mapped>& map() const { return map_; }  ///< in the order of belief().landmarks
  std::span<const Decision> decided() const { return decided_; }  ///< by sighting of the last frame

  /// By sighting of the last frame: what became of it, with the index in map() of the landmark that it was
  /// held against, and what was expected of it.
  std::span<const Target> targets() const { return targets_; }
  std::span<const ExpectedSighting> expected() const { return expected_; }

  /// The sightings of the last frame that corrected or found a landmark, with its index in map().
  const std::vector<UsedSighting>& used() const { return used_; }

  /// The landmarks that the last frame showed to be others.
  std::span<const Merged> merged() const { return merged_; }

  /// @return what had to be repaired or refused since the last call
  FilterCounters take_counters() { return std::exchange(counters_, {}); }

  /// What the last frame added to the covariance of the pose (x, y, heading), since it had drifted.
  const Eigen::Matrix3d& drift() const { return drift_; }

 private:
  /// A frame beside what becomes of it.
  struct Decided {
    std::span<const Sighting> frame;
    std::vector<Target>& targets;
    std::vector<std::size_t> order;  ///< of the sightings that correct the pose: oldest landmarks first
  };
  struct View;

  Landmark landmark(std::size_t j) const;
  Decided decide(std::span<const Sighting> frame, const Eigen::Matrix3d& room);
  void correct_iterated(Decided& decided, JointBelief before, const PoseBelief& motion);
  std::optional<FrameMode> leave_out_outliers(const Decided& decided, const JointBelief& before,
                                              const ChordBelief& motion, std::vector<std::size_t>& used);
  bool judge_refused(Decided& decided, std::vector<std::size_t>& used, JointBelief& before);
  static std::vector<SeenLandmark> seen_by(const Decided& decided, const std::vector<std::size_t>& used);
  void correct_one_by_one(Decided& decided);
  Outcome correct_by(int landmark, const Sighting& sighting, bool corroborated, ExpectedSighting& expected);
  JointInnovation innovation_of_used(const Decided& decided, std::size_t sighting, const JointBelief& at,
                                     bool by_sigma_points);
  ExpectedSighting correct_and_note(int landmark, const JointInnovation& seen, const Observation& observation,
                                    bool teaches);
  void expect_of_refused(const Decided& decided);
  void find_landmark(int landmark, const Observation& observation);
  void learn(const Target& target, const Sighting& sighting);
  bool merge_doubles(int recent, std::size_t shown);

  FilterConfig config_;
  Linearisation linearisation_;
  AssociationPolicy policy_;
  MapManagement management_;
  Linearised model_;
  Unscented unscented_;
  FrameReader reader_;
  JointBelief belief_;  ///< at the last update
  PoseBelief motion_;   ///< since the last update, in the robot's frame of that time
  std::vector<Mapped> map_;
  std::vector<Decision> decided_;  ///< of the last frame, as all below
  std::vector<Target> targets_;
  std::vector<ExpectedSighting> expected_;
  std::vector<UsedSighting> used_;
  std::vector<Merged> merged_;
  Eigen::Matrix3d drift_ = Eigen::Matrix3d::Zero();
  int frames_ = 0;
  FilterCounters counters_;
  UpdateReport report_;  ///< of the last update
};

}  // namespace stereobench::slam
