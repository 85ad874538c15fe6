#include "harness/run/run_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "harness/dataset/atomic_file.h"
#include "harness/report/error_picture.h"
#include "harness/report/map_picture.h"
#include "slam/belief.h"

namespace stereobench::harness {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

std::string map_of(const RunResult& result, const SeedDrive& drive, const std::vector<worlds::Wall>& walls) {
  MapPicture picture{.title = fmt::format("{}, seed {}", result.name, drive.seed), .walls = walls};
  picture.landmarks = drive.recording.log.landmarks;
  for (const LogStep& step : drive.recording.log.steps)
    if (step.truth) picture.true_path.push_back(*step.truth);
  for (const FilterRun& run : drive.runs)
    picture.estimates.push_back({run.filter, run.poses, run.last.landmarks});
  const FilterRun& batch = drive.references.batch;
  if (!batch.failed) picture.estimates.push_back({batch.filter, batch.poses, {}});
  return draw_map_picture(picture);
}

std::vector<double> position_errors(const FilterRun& run, const MeasurementLog& log) {
  std::vector<double> errors(log.steps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < run.poses.size(); ++k)
    if (log.steps[k].truth)
      errors[k] = slam::displacement(run.poses[k], *log.steps[k].truth).head<2>().norm();
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
  ErrorPicture picture{.title = fmt::format("{}: position error, {} seed{}", result.name, drives.size(),
                                            drives.size() == 1 ? "" : "s")};
  for (const LogStep& step : drives.front().recording.log.steps)
    picture.time_s.push_back(static_cast<double>(step.stamp_ns) * kSecondsPerNanosecond);
  for (std::size_t i = 0; i < result.filters.size(); ++i) {
    ErrorCurves curves{.filter = result.filters[i].filter};
    for (const SeedDrive& drive : drives)
      curves.error_m_by_run.push_back(position_errors(drive.runs[i], drive.recording.log));
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
  write_file_atomically(out / "timing.json", timing_json(drives).dump(2) + "\n");
  write_file_atomically(out / "run.json", run_json(result).dump(2) + "\n");
}

}  // namespace stereobench::harness
