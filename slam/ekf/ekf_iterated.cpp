/// The updates of EkfSlam that look for the mode of a frame first.
#include <algorithm>

#include "slam/association/contradiction.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/ekf/frame_mode.h"
#include "slam/ekf/joint_moments.h"
#include "slam/models/chord.h"

namespace stereobench::slam {
namespace {

/// Greatest bend of a frame that is taken by sigma points. Where it bends more, what they scatter off their
/// line is noise that slopes at the mode do not have. The room is best with many frames by sigma points,
/// ball_circle with few (lab book, iterated frames in blocks).
constexpr double kStraight = 10.0;

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
  if (used.empty()) return expect_of_refused(decided);
  const bool by_sigma_points = linearisation_ == Linearisation::kSigmaPoints && mode->bend < kStraight;
  JointBelief at{end_of(mode->from, mode->chord), belief_.landmarks, {}};
  for (std::size_t i = 0; i < used.size(); ++i)
    at.landmarks[static_cast<std::size_t>(decided.targets[used[i]].landmark)] = mode->landmarks[i];
  belief_ = by_sigma_points ? std::move(before) : predict_at(*mode, std::move(before), chord);
  if (by_sigma_points) follow(belief_, motion);
  long& repairs = counters_.covariance_repairs;
  for (const std::size_t k : used) {
    const long repairs_before = repairs;
    const JointInnovation seen = innovation_of_used(decided, k, at, by_sigma_points);
    if (config_.report_updates)
      report_.innovations.push_back({decided.frame[k].index, seen.squared_length()});
    expected_[k] = correct_and_note(decided.targets[k].landmark, seen, decided.frame[k].observation,
                                    repairs == repairs_before);
  }
  expect_of_refused(decided);
}

/// @param at the mode of its frame
JointInnovation EkfSlam::innovation_of_used(const Decided& decided, std::size_t sighting,
                                            const JointBelief& at, bool by_sigma_points) {
  const int landmark = decided.targets[sighting].landmark;
  const Observation& observation = decided.frame[sighting].observation;
  long& repairs = counters_.covariance_repairs;
  return by_sigma_points ? innovation(unscented_, belief_, landmark, observation, repairs)
                         : innovation(belief_, at, landmark, observation, repairs);
}

/// What a frame's refused sightings cost: as much as one at the gate, seen from the corrected pose.
void EkfSlam::expect_of_refused(const Decided& decided) {
  for (const std::size_t k : decided.order) {
    if (decided.targets[k].outcome == Outcome::kUse) continue;
    const Observation& observation = decided.frame[k].observation;
    const JointInnovation seen =
        innovation(belief_, decided.targets[k].landmark, observation, counters_.covariance_repairs);
    expected_[k] = expectation(seen, observation, policy_.gate);
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
    if (used.size() == decided.order.size()) ++counters_.refitted_frames;
    if (config_.report_updates) report_.innovations.push_back({decided.frame[k].index, *worst, true});
    std::erase(used, k);
  }
}

/// Decides for each sighting that was left out who is wrong. Where it is the pose, the sighting is used after
/// all, and the pose before is as uncertain as that takes.
///
/// @return whether the pose was wrong
bool EkfSlam::judge_refused(Decided& decided, std::vector<std::size_t>& used, JointBelief& before) {
  bool corroborated = false;  // by an older landmark
  bool drifted = false;
  for (const std::size_t k : decided.order) {
    Target& target = decided.targets[k];
    if (std::ranges::find(used, k) != used.end()) {
      corroborated = true;
      continue;
    }
    const auto j = static_cast<std::size_t>(target.landmark);
    const Sighting& sighting = decided.frame[k];
    target.outcome = judge_contradiction(map_[j].status.record, policy_.is_certain(sighting), corroborated);
    if (target.outcome != Outcome::kUse) continue;
    const Eigen::Matrix3d drift = drift_covariance(belief_.pose, belief_.landmarks[j], sighting.observation);
    before.covariance.move_pose(Eigen::Vector2d::Zero(), drift);
    drift_ += drift;
    used.push_back(k);
    drifted = corroborated = true;
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
