#include "harness/run/seed_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/io/gzip.h"
#include "harness/run/consistency_report.h"
#include "harness/scoring/association_score.h"
#include "slam/math/elementary.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

void append_step(std::string& csv, std::uint64_t seed, const FilterRun& run, const FilterScore& score,
                 const LogStep& step, std::size_t k) {
  const slam::Pose& pose = run.poses[k];
  csv += fmt::format("{},{},{},{},{},{},{},{}", seed, run.filter, k, step.stamp_ns, pose.x_m, pose.y_m,
                     pose.heading_rad, step.measurements.size());
  const double error_m = position_error_m(score, pose, step);
  if (step.truth)
    csv += fmt::format(",{},{},{},", step.truth->x_m, step.truth->y_m, step.truth->heading_rad);
  else
    csv += ",,,,";
  if (std::isfinite(error_m)) csv += fmt::format("{}", error_m);
  const auto& nees = score.normalised_errors;
  csv += k < nees.size() && nees[k] ? fmt::format(",{}", nees[k]->ratio()) : std::string(",");
  csv += consistency_cells(run, score, step, k) + "\n";
}

std::vector<double> position_errors(const FilterRun& run, const FilterScore& score,
                                    const MeasurementLog& log) {
  std::vector<double> errors_m(log.steps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < run.poses.size(); ++k)
    errors_m[k] = position_error_m(score, run.poses[k], log.steps[k]);
  return errors_m;
}

std::vector<SquaredSum> innovations_of(const FilterRun& run, std::size_t steps) {
  std::vector<SquaredSum> sums(steps);
  for (std::size_t k = 0; k < std::min(steps, run.updates.size()); ++k) {
    InnovationSum sum;
    for (const slam::NormalisedInnovation& innovation : run.updates[k].innovations) sum.add(innovation);
    sums[k] = sum.all;
  }
  return sums;
}

/// Adds what is drawn and listed of each step.
void add_steps(const SeedDrive& drive, SeedResult& result) {
  const MeasurementLog& log = drive.recording.log;
  for (const LogStep& step : log.steps)
    result.time_s.push_back(static_cast<double>(step.stamp_ns) * kSecondsPerNanosecond);
  for (std::size_t i = 0; i < drive.runs.size(); ++i) {
    const FilterRun& run = drive.runs[i];
    ScoredRun& scored = result.runs[i];
    scored.errors_m = position_errors(run, scored.score, log);
    scored.innovations = innovations_of(run, log.steps.size());
    for (std::size_t k = 0; k < run.poses.size(); ++k)
      append_step(result.csv, drive.seed, run, scored.score, log.steps[k], k);
  }
  if (!drive.references.bound) return;
  for (const Eigen::Matrix3d& covariance : drive.references.bound->poses)
    result.bound_m2.push_back(covariance.topLeftCorner<2, 2>().trace());
}

/// A filter's path and map in the truth's frame, or in its own where nothing tells how both lie.
MapEstimate estimate_of(const FilterRun& run, const FilterScore& score) {
  const slam::Pose truth_from_estimate = score.truth_from_estimate.value_or(slam::Pose{});
  MapEstimate estimate{run.filter, {}, run.last.landmarks};
  for (const slam::Pose& pose : run.poses) estimate.path.push_back(slam::compose(truth_from_estimate, pose));
  for (slam::LandmarkEstimate& landmark : estimate.landmarks)
    landmark = moved_landmark(truth_from_estimate, landmark);
  return estimate;
}

/// Where nothing tells how estimates lie to the truth, the map shows the estimates alone.
MapPicture map_of(const SeedDrive& drive, const SeedResult& result) {
  MapPicture picture;
  bool comparable = true;
  for (std::size_t i = 0; i < drive.runs.size(); ++i) {
    const FilterScore& score = result.runs[i].score;
    comparable = comparable && (score.failed || score.truth_from_estimate);
    picture.estimates.push_back(estimate_of(drive.runs[i], score));
  }
  if (!drive.references.batch.failed) {
    picture.estimates.push_back(estimate_of(drive.references.batch, result.batch));
    picture.estimates.back().landmarks.clear();
  }
  if (!comparable) return picture;
  picture.landmarks = drive.recording.log.landmarks;
  for (const LogStep& step : drive.recording.log.steps)
    if (step.truth) picture.true_path.push_back(*step.truth);
  return picture;
}

/// The covariances of a filter's positions, turned as its path is.
std::vector<Eigen::Matrix2d> covariances_of(const FilterRun& run, const FilterScore& score) {
  const double turn_rad = score.truth_from_estimate.value_or(slam::Pose{}).heading_rad;
  const auto [s, c] = slam::sine_cosine(turn_rad);
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  std::vector<Eigen::Matrix2d> covariances;
  for (const Eigen::Matrix3d& covariance : run.covariances)
    covariances.emplace_back(turn * covariance.topLeftCorner<2, 2>() * turn.transpose());
  return covariances;
}

/// @param map of the same drive: where it shows no truth, nothing can be compared with it
MapTrack track_of(const SeedDrive& drive, const SeedResult& result, const MapPicture& map) {
  MapTrack track;
  for (std::size_t i = 0; i < drive.runs.size(); ++i)
    track.covariances.push_back(covariances_of(drive.runs[i], result.runs[i].score));
  for (const LogStep& step : drive.recording.log.steps) {
    track.truth.push_back(map.true_path.empty() ? std::nullopt : step.truth);
    track.seen_m.emplace_back();
    if (!track.truth.back()) continue;
    for (const slam::RangeBearing& seen : step.measurements) {
      const auto [s, c] = slam::sine_cosine(step.truth->heading_rad + seen.bearing_rad);
      track.seen_m.back().emplace_back(step.truth->x_m + seen.range_m * c,
                                       step.truth->y_m + seen.range_m * s);
    }
  }
  return track;
}

ScoredRun score_run(const FilterRun& run, const MeasurementLog& log) {
  return {run.filter, run.particles, score(run, log), run.association, run.last.counters, {}, {}};
}

}  // namespace

SeedResult score_seed(const SeedDrive& drive, const SeedParts& parts) {
  const Recording& recording = drive.recording;
  SeedResult result{.seed = drive.seed,
                    .detector = recording.detector,
                    .vision = recording.vision,
                    .faults = recording.faults,
                    .blur = recording.blur,
                    .timing = recording.timing,
                    .steps = static_cast<long>(recording.log.steps.size()),
                    .start_is_true = recording.log.start_is_true,
                    .identities_known = knows_identities(recording.log),
                    .batch = score(drive.references.batch, recording.log),
                    .snapshots = drive.snapshots,
                    .pairs = drive.pairs};
  for (const FilterRun& run : drive.runs) result.runs.push_back(score_run(run, recording.log));
  if (drive.references.bound) result.bound = score(*drive.references.bound);
  if (parts.steps) add_steps(drive, result);
  if (parts.map) {
    result.map = map_of(drive, result);
    result.track = track_of(drive, result, *result.map);
  }
  if (parts.detections && recording.vision) result.detections_gz = gzip(drive.detections);
  if (parts.log) result.log = sensor_log(recording.log);
  return result;
}

std::string steps_csv_header() {
  return "seed,filter,step,stamp_ns,x_m,y_m,heading_rad,measurements,"
         "true_x_m,true_y_m,true_heading_rad,error_m,normalised_error," +
         consistency_columns() + "\n";
}

}  // namespace stereobench::harness
