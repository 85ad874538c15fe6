#include "harness/run/run_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "harness/io/atomic_file.h"
#include "harness/report/error_picture.h"
#include "harness/report/map_picture.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

/// What a title says where estimates were moved into the truth's frame.
std::string alignment_note(const RunResult& result) {
  return result.start_is_true ? "" : ", aligned";
}

/// A filter's path and map in the truth's frame.
MapEstimate estimate_of(const FilterRun& run, const slam::Pose& truth_from_estimate) {
  MapEstimate estimate{run.filter, {}, run.last.landmarks};
  for (const slam::Pose& pose : run.poses) estimate.path.push_back(slam::compose(truth_from_estimate, pose));
  for (slam::LandmarkEstimate& landmark : estimate.landmarks)
    landmark = moved_landmark(truth_from_estimate, landmark);
  return estimate;
}

/// The first seed's map. Where nothing tells how estimates lie to the truth, it shows the estimates alone.
std::string map_of(const RunResult& result, const SeedDrive& drive, const std::vector<worlds::Wall>& walls) {
  MapPicture picture{.title = fmt::format("{}, seed {}{}", result.name, drive.seed, alignment_note(result)),
                     .walls = walls};
  bool comparable = true;
  for (std::size_t i = 0; i < drive.runs.size(); ++i) {
    const FilterScore& score = result.filters[i].scores.front();
    comparable = comparable && (score.failed || score.truth_from_estimate);
    picture.estimates.push_back(estimate_of(drive.runs[i], score.truth_from_estimate.value_or(slam::Pose{})));
  }
  const FilterRun& batch = drive.references.batch;
  const FilterScore& batch_score = result.batch.scores.front();
  if (!batch.failed) {
    picture.estimates.push_back(estimate_of(batch, batch_score.truth_from_estimate.value_or(slam::Pose{})));
    picture.estimates.back().landmarks.clear();
  }
  if (!comparable) return draw_map_picture(picture);
  picture.landmarks = drive.recording.log.landmarks;
  for (const LogStep& step : drive.recording.log.steps)
    if (step.truth) picture.true_path.push_back(*step.truth);
  return draw_map_picture(picture);
}

std::vector<double> position_errors(const FilterRun& run, const FilterScore& score,
                                    const MeasurementLog& log) {
  std::vector<double> errors(log.steps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < run.poses.size(); ++k)
    errors[k] = position_error_m(score, run.poses[k], log.steps[k]);
  return errors;
}

/// The bound's rms over the seeds at each step; empty where there is none.
std::vector<double> bound_of(std::span<const SeedDrive> drives) {
  if (!drives.front().references.bound) return {};
  std::vector<double> bound_m;
  for (std::size_t k = 0; k < drives.front().references.bound->poses.size(); ++k) {
    double sum_m2 = 0.0;
    for (const SeedDrive& drive : drives)
      sum_m2 += drive.references.bound->poses[k].topLeftCorner<2, 2>().trace();
    bound_m.push_back(std::sqrt(sum_m2 / static_cast<double>(drives.size())));
  }
  return bound_m;
}

/// Each filter's normalised errors, and the widest of the filters' bands at each step.
AneesPanel anees_of(const RunResult& result, std::size_t steps) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  AneesPanel panel{.low = std::vector<double>(steps, kNone), .high = std::vector<double>(steps, kNone)};
  std::vector<long> least(steps, 0);
  for (const FilterResult& filter : result.filters) {
    AneesCurve curve{filter.filter, std::vector<double>(steps, kNone)};
    const std::vector<SquaredSum>& nees = filter.summary.nees_by_step;
    for (std::size_t k = 0; k < std::min(steps, nees.size()); ++k) {
      const long degrees = nees[k].degrees_of_freedom;
      if (degrees == 0) continue;
      curve.anees[k] = nees[k].ratio();
      least[k] = least[k] == 0 ? degrees : std::min(least[k], degrees);
    }
    panel.filters.push_back(std::move(curve));
  }
  std::map<long, Band> bands;  // most steps share theirs
  for (std::size_t k = 0; k < steps; ++k) {
    const auto [band, is_new] = bands.try_emplace(least[k]);
    if (is_new) band->second = chi_square_band(0.95, least[k]);
    panel.low[k] = band->second.low;
    panel.high[k] = band->second.high;
  }
  return panel;
}

std::string errors_of(const RunResult& result, std::span<const SeedDrive> drives) {
  ErrorPicture picture{.title =
                           fmt::format("{}: position error{}, {} seed{}", result.name, alignment_note(result),
                                       drives.size(), drives.size() == 1 ? "" : "s")};
  for (const LogStep& step : drives.front().recording.log.steps)
    picture.time_s.push_back(static_cast<double>(step.stamp_ns) * kSecondsPerNanosecond);
  for (std::size_t i = 0; i < result.filters.size(); ++i) {
    ErrorCurves curves{.filter = result.filters[i].filter};
    for (std::size_t d = 0; d < drives.size(); ++d)
      curves.error_m_by_run.push_back(
          position_errors(drives[d].runs[i], result.filters[i].scores[d], drives[d].recording.log));
    picture.filters.push_back(std::move(curves));
  }
  picture.bound_m = bound_of(drives);
  picture.anees = anees_of(result, picture.time_s.size());
  return draw_error_picture(picture);
}

}  // namespace

void write_run(const std::filesystem::path& out, const RunResult& result, std::span<const SeedDrive> drives,
               const std::vector<worlds::Wall>& walls) {
  write_file_atomically(out / "map.png", map_of(result, drives.front(), walls));
  write_file_atomically(out / "error.png", errors_of(result, drives));
  for (const SeedDrive& drive : drives) {
    if (!drive.snapshots.empty()) prepare_output_folder(out / "frames");
    for (const Snapshot& snapshot : drive.snapshots)
      write_file_atomically(out / "frames" / fmt::format("seed{}_step{:04}.png", drive.seed, snapshot.step),
                            snapshot.png);
  }
  write_file_atomically(out / "steps.csv", steps_csv(result, drives));
  write_file_atomically(out / "timing.json", timing_json(timing_of(drives), drives.size()).dump(2) + "\n");
  if (result.made_from) write_file_atomically(out / kResolvedScenario, result.made_from->scenario);
  write_file_atomically(out / "run.json", run_json(result).dump(2) + "\n");
}

}  // namespace stereobench::harness
