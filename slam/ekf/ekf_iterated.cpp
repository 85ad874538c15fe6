/// The updates of EkfSlam that look for the mode of a frame first.
#include <algorithm>

#include "slam/association/contradiction.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/ekf/frame_mode.h"
#include "slam/models/chord.h"

namespace stereobench::slam {
namespace {

/// The belief after a motion, to first order at the mode of a frame.
JointBelief predict_at(const FrameMode& mode, const JointBelief& before, const ChordBelief& motion) {
  const Pose robot = end_of(mode.from, mode.chord);
  const Eigen::Vector2d swing = heading_lever(mode.from, {robot.x_m, robot.y_m});
  const Eigen::Matrix3d by_chord = end_by_chord(mode.from, mode.chord);
  const Eigen::Vector3d off = boxminus(before.pose, mode.from);
  Eigen::Vector3d shift = off + by_chord * (motion.mean - mode.chord);
  shift.head<2>() += swing * off.z();
  JointBelief predicted = before;
  predicted.pose = boxplus(robot, shift);
  predicted.covariance.move_pose(swing, by_chord * motion.covariance * by_chord.transpose());
  return predicted;
}

}  // namespace

/// Fits the frame to its mode, without the sightings that the others speak against, and corrects the belief
/// by what is left, linearised there.
///
/// @param before the motion
void EkfSlam::correct_iterated(Decided& decided, JointBelief before, const PoseBelief& motion) {
  const ChordBelief chord = chord_with_slack(motion);
  std::vector<std::size_t> used = decided.order;
  std::optional<FrameMode> mode = leave_out_outliers(decided, before, chord, used);
  if (!mode) return correct_one_by_one(decided);
  if (const bool drifted = judge_refused(decided, used, before); drifted) {
    mode = frame_mode(before, chord, seen_by(decided, used));
    if (!mode) return correct_one_by_one(decided);
  }
  if (used.empty()) return;
  JointBelief at{end_of(mode->from, mode->chord), belief_.landmarks, {}};
  for (std::size_t i = 0; i < used.size(); ++i)
    at.landmarks[static_cast<std::size_t>(decided.targets[used[i]].landmark)] = mode->landmarks[i];
  belief_ = predict_at(*mode, before, chord);
  long& repairs = counters_.covariance_repairs;
  for (const std::size_t k : used) {
    const int landmark = decided.targets[k].landmark;
    const long repairs_before = repairs;
    const JointInnovation seen = innovation(belief_, at, landmark, decided.frame[k].observation, repairs);
    if (config_.report_updates)
      report_.innovations.push_back({decided.frame[k].index, seen.squared_length()});
    if (repairs == repairs_before) correct(belief_, landmark, seen, repairs);
  }
}

/// @param used loses the sightings beyond the gate, the worst first
/// @return the mode without them; nothing where there is none
std::optional<FrameMode> EkfSlam::leave_out_outliers(const Decided& decided, const JointBelief& before,
                                                     const ChordBelief& motion,
                                                     std::vector<std::size_t>& used) {
  for (;;) {
    std::optional<FrameMode> mode = frame_mode(before, motion, seen_by(decided, used));
    if (!mode || used.empty()) return mode;
    const auto worst = std::ranges::max_element(mode->squared_lengths);
    if (*worst <= policy_.gate) return mode;
    const std::size_t k = used[static_cast<std::size_t>(worst - mode->squared_lengths.begin())];
    ++counters_.gated_measurements;
    if (config_.report_updates) report_.innovations.push_back({decided.frame[k].index, *worst, true});
    std::erase(used, k);
  }
}

/// Decides for each sighting that was left out who is wrong. Where it is the pose, the sighting is used after
/// all, and the pose before is as uncertain as that takes.
///
/// @return whether the pose was wrong
bool EkfSlam::judge_refused(Decided& decided, std::vector<std::size_t>& used, JointBelief& before) {
  const bool corroborated = !used.empty();
  bool drifted = false;
  for (const std::size_t k : decided.order) {
    Target& target = decided.targets[k];
    if (std::ranges::find(used, k) != used.end()) continue;
    const auto j = static_cast<std::size_t>(target.landmark);
    const Sighting& sighting = decided.frame[k];
    target.outcome =
        judge_contradiction(map_[j].status.record, policy_.is_certain(sighting), corroborated || drifted);
    if (target.outcome != Outcome::kUse) continue;
    const Eigen::Matrix3d drift = drift_covariance(belief_.pose, belief_.landmarks[j], sighting.observation);
    before.covariance.move_pose(Eigen::Vector2d::Zero(), drift);
    drift_ += drift;
    used.push_back(k);
    drifted = true;
  }
  return drifted;
}

std::vector<SeenLandmark> EkfSlam::seen_by(const Decided& decided, const std::vector<std::size_t>& used) {
  std::vector<SeenLandmark> seen;
  for (const std::size_t k : used)
    seen.push_back({decided.targets[k].landmark, decided.frame[k].observation});
  return seen;
}

}  // namespace stereobench::slam
