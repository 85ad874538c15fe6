#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/geometry/link_statistics.h"
#include "harness/verify/readers/log/mrclam_log.h"
#include "harness/verify/readers/log/sighting_limits.h"
#include "slam/math/angles.h"
#include "slam/models/measurement.h"

namespace stereobench::harness {
namespace {

/// A sighting, the pose from which it was made, and where landmarks are: what a cause changes.
struct SightingClaim {
  slam::Pose pose;
  double range_m = 0.0;
  double bearing_rad = 0.0;
  double landmark_scale = 1.0;
  bool landmarks_are_turned = false;  ///< x is y
};

/// What may be wrong with all lines of a file.
struct SightingCause {
  const char* cause;
  bool is_of_sightings;  ///< or of true poses and landmarks
  void (*undo)(SightingClaim& claim);
  std::ptrdiff_t late = 0;  ///< lines by which poses come later
};

constexpr double kHundred = 100.0, kThousand = 1000.0;

constexpr std::array kSightingCauses = {
    SightingCause{"", true, [](SightingClaim&) {}},
    SightingCause{"bearings have the other sign", true, [](SightingClaim& at) { at.bearing_rad *= -1.0; }},
    SightingCause{"bearings are in degrees", true,
                  [](SightingClaim& at) { at.bearing_rad *= slam::kRadPerDegree; }},
    SightingCause{"ranges are in centimetres", true, [](SightingClaim& at) { at.range_m /= kHundred; }},
    SightingCause{"ranges are in millimetres", true, [](SightingClaim& at) { at.range_m /= kThousand; }},
    SightingCause{"range and bearing are swapped", true,
                  [](SightingClaim& at) { std::swap(at.range_m, at.bearing_rad); }},
    SightingCause{"sightings are a frame late, or poses a frame early", true, [](SightingClaim&) {}, -1},
    SightingCause{"poses are a frame late, or sightings a frame early", false, [](SightingClaim&) {}, 1},
    SightingCause{"headings have the other sign", false,
                  [](SightingClaim& at) { at.pose.heading_rad *= -1.0; }},
    SightingCause{"headings are in degrees", false,
                  [](SightingClaim& at) { at.pose.heading_rad *= slam::kRadPerDegree; }},
    SightingCause{"headings are clockwise from the y axis", false,
                  [](SightingClaim& at) { at.pose.heading_rad = slam::kPi / 2 - at.pose.heading_rad; }},
    SightingCause{"x and y of poses are swapped", false,
                  [](SightingClaim& at) { std::swap(at.pose.x_m, at.pose.y_m); }},
    SightingCause{"x and y of landmarks are swapped", false,
                  [](SightingClaim& at) { at.landmarks_are_turned = true; }},
    SightingCause{"poses are in centimetres", false,
                  [](SightingClaim& at) { at.pose.x_m /= kHundred, at.pose.y_m /= kHundred; }},
    SightingCause{"landmarks are in centimetres", false,
                  [](SightingClaim& at) { at.landmark_scale /= kHundred; }},
    SightingCause{"poses and landmarks are in centimetres", false, [](SightingClaim& at) {
                    at.pose.x_m /= kHundred, at.pose.y_m /= kHundred;
                    at.landmark_scale /= kHundred;
                  }}};

/// By how much a sighting is off, m: how far apart the landmark is from where it was seen.
/// @param place_m of the landmark, as its file has it
double off_landmark_m(const SightingClaim& claim, Eigen::Vector2d place_m) {
  if (claim.landmarks_are_turned) std::swap(place_m.x(), place_m.y());
  const Eigen::Vector2d expected = slam::predict_sighting(claim.pose, claim.landmark_scale * place_m);
  const double turn_rad = slam::wrap_angle(claim.bearing_rad - expected[1]);
  // Across by the arc: a chord would forgive what is seen behind.
  return Eigen::Vector2d(claim.range_m - expected[0], expected[0] * turn_rad).norm();
}

/// A sighting that true poses and landmarks say something of.
struct KnownSighting {
  const MrclamSighting* sighting = nullptr;
  const Eigen::Vector2d* landmark_m = nullptr;  ///< null where nobody was recognised: the nearest one is it
  int subject = 0;
};

/// @return empty where there is no such pose
std::optional<double> off_m(const MrclamLog& log, const MrclamRobot& robot, const KnownSighting& known,
                            const SightingCause& cause) {
  const auto pose = true_pose(robot.truth, known.sighting->stamp_ns, cause.late);
  if (!pose) return std::nullopt;
  SightingClaim claim = {*pose, known.sighting->range_m, known.sighting->bearing_rad};
  cause.undo(claim);
  if (known.landmark_m != nullptr) return off_landmark_m(claim, *known.landmark_m);
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& [subject, place_m] : log.landmarks_m)
    least_m = std::min(least_m, off_landmark_m(claim, place_m));
  return least_m;
}

/// The sightings of landmarks, and of what was not recognised.
std::vector<KnownSighting> known_sightings(const MrclamLog& log, const MrclamRobot& robot) {
  std::vector<KnownSighting> known;
  for (const MrclamSighting& sighting : robot.sightings) {
    const auto subject = log.subjects.find(sighting.barcode);
    if (sighting.barcode == 0 && subject == log.subjects.end()) known.push_back({&sighting});
    if (subject == log.subjects.end()) continue;
    const auto landmark = log.landmarks_m.find(subject->second);
    if (landmark != log.landmarks_m.end()) known.push_back({&sighting, &landmark->second, subject->second});
  }
  return known;
}

/// All residuals under a cause; those that it says nothing of are left out.
std::vector<double> all_off_m(const MrclamLog& log, const MrclamRobot& robot,
                              const std::vector<KnownSighting>& known, const SightingCause& cause) {
  std::vector<double> all;
  for (const KnownSighting& one : known)
    if (const auto off = off_m(log, robot, one, cause)) all.push_back(*off);
  return all;
}

/// The cause that leaves the least, where that is much less than without one.
const SightingCause& best_cause(DatasetView& view, const MrclamLog& log, const MrclamRobot& robot,
                                const std::vector<KnownSighting>& known, bool may_be_late) {
  constexpr std::size_t kFewest = 8;
  const SightingCause* best = &kSightingCauses.front();
  const std::vector<double> before = all_off_m(log, robot, known, *best);
  const double none_m = kMostLeftBehindCause * median(before);
  double least_m = none_m;
  for (const SightingCause& cause : kSightingCauses) {
    if (may_be_late && cause.late != 0) continue;
    const std::vector<double> off = all_off_m(log, robot, known, cause);
    if (off.size() < kFewest || 2 * off.size() < before.size()) continue;
    if (&cause != &kSightingCauses.front()) view.margins.is_beyond("cause of sightings", none_m, median(off));
    if (median(off) >= least_m) continue;
    best = &cause;
    least_m = median(off);
  }
  return *best;
}

/// What sightings are off in the middle: m, and as a share of their range.
struct UsualOff {
  double off_m = 0.0;
  double share = 0.0;
};

UsualOff usual_off(const MrclamLog& log, const MrclamRobot& robot, const std::vector<KnownSighting>& known,
                   const SightingCause& cause) {
  std::vector<double> all_m, shares;
  for (const KnownSighting& one : known)
    if (const auto off = off_m(log, robot, one, cause)) {
      all_m.push_back(*off);
      shares.push_back(*off / std::max(kNoise_m, one.sighting->range_m));
    }
  return {median(all_m), median(shares)};
}

/// What a sighting may be off, m: many times what others are, and what pictures that are late make of it.
double most_off_m(const MrclamSighting& sighting, const UsualOff& usual) {
  return std::max(kMostOfUsualSighting * std::max(usual.off_m, usual.share * sighting.range_m),
                  kNoise_m + kNoiseShare * sighting.range_m);
}

/// Landmarks whose sightings are off together: they are elsewhere, or have another's name.
/// @return the sightings of all others
std::vector<KnownSighting> without_moved_landmarks(DatasetView& view, const MrclamLog& log,
                                                   const MrclamRobot& robot,
                                                   const std::vector<KnownSighting>& known,
                                                   const SightingCause& cause, const UsualOff& usual) {
  constexpr std::size_t kFewest = 3;
  std::map<int, std::vector<double>> off_by_subject, beyond_by_subject;
  for (const KnownSighting& one : known) {
    const auto off = off_m(log, robot, one, cause);
    if (one.subject == 0 || !off) continue;
    off_by_subject[one.subject].push_back(*off);
    beyond_by_subject[one.subject].push_back(*off / most_off_m(*one.sighting, usual));
  }
  std::erase_if(beyond_by_subject, [&](const auto& one) {
    return one.second.size() < kFewest || !view.margins.is_beyond("landmark", median(one.second), 1.0);
  });
  std::vector<KnownSighting> others;
  for (const KnownSighting& one : known)
    if (!beyond_by_subject.contains(one.subject)) others.push_back(one);
  for (const auto& [subject, beyond] : beyond_by_subject)
    view.faults.push_back(
        {robot.sightings_file, "",
         fmt::format(
             "landmark {}: its {} sightings are {:.3g} m off in the middle, where {:.2g} m are usual: "
             "it is elsewhere than {} says, or has another's barcode",
             subject, beyond.size(), median(off_by_subject[subject]), usual.off_m, kMrclamLandmarks)});
  return others;
}

void find_single_sightings(DatasetView& view, const MrclamLog& log, const MrclamRobot& robot,
                           const std::vector<KnownSighting>& known, const SightingCause& cause,
                           const UsualOff& usual) {
  for (const KnownSighting& one : known) {
    const auto off = off_m(log, robot, one, cause);
    if (!off || !view.margins.is_beyond("single sighting", *off, most_off_m(*one.sighting, usual))) continue;
    const std::string whom =
        one.subject == 0 ? "the nearest landmark" : fmt::format("landmark {}", one.subject);
    view.faults.push_back(
        {robot.sightings_file, one.sighting->time,
         fmt::format(
             "line {}: range {:.4g} m and bearing {:.4g} rad are {:.3g} m off {}, where {:.2g} m are usual",
             one.sighting->line, one.sighting->range_m, one.sighting->bearing_rad, *off, whom, usual.off_m)});
  }
}

}  // namespace

void check_sightings(DatasetView& view, const MrclamLog& log, const MrclamRobot& robot, bool may_be_late) {
  const std::vector<KnownSighting> known = known_sightings(log, robot);
  const SightingCause& cause = best_cause(view, log, robot, known, may_be_late);
  const SightingCause& none = kSightingCauses.front();
  const UsualOff usual = usual_off(log, robot, known, cause);
  const std::size_t count = all_off_m(log, robot, known, none).size();
  if (&cause != &none)
    view.faults.push_back(
        {cause.is_of_sightings ? robot.sightings_file : robot.truth_file, "",
         fmt::format("{} ({:.3g} m off in the middle of {} sightings, {:.2g} m without it)", cause.cause,
                     median(all_off_m(log, robot, known, none)), count, usual.off_m)});
  find_single_sightings(view, log, robot, without_moved_landmarks(view, log, robot, known, cause, usual),
                        cause, usual);
  if (count > 0)
    view.checked.push_back(fmt::format("ranges and bearings against poses ({} sightings)", count));
  if (count < robot.sightings.size())
    view.cannot.push_back(
        fmt::format("{} sightings of {}: of robots or barcodes that are not listed, or at times "
                    "without a true pose",
                    robot.sightings.size() - count, robot.sightings_file));
}

}  // namespace stereobench::harness
