#include "harness/run/run_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "harness/io/gzip.h"
#include "harness/json/json_text.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

/// What a title says where estimates were moved into the truth's frame.
std::string alignment_note(const RunResult& result) {
  return result.start_is_true ? "" : ", aligned";
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

}  // namespace

void RunCurves::add(const SeedResult& seed) {
  if (seeds++ == 0) {
    first = seed;
    first.csv = {};
    first.detections_gz = {};
    first.pairs = {};
    bound_m2.assign(seed.bound_m2.size(), 0.0);
    innovations.assign(seed.runs.size(), std::vector<SquaredSum>(seed.time_s.size()));
    for (const ScoredRun& run : seed.runs) errors.emplace_back(run.filter);
  }
  for (std::size_t i = 0; i < std::min(errors.size(), seed.runs.size()); ++i) {
    errors[i].add(seed.runs[i].errors_m);
    const std::vector<SquaredSum>& sums = seed.runs[i].innovations;
    for (std::size_t k = 0; k < std::min(innovations[i].size(), sums.size()); ++k)
      innovations[i][k] += sums[k];
  }
  for (std::size_t k = 0; k < std::min(bound_m2.size(), seed.bound_m2.size()); ++k)
    bound_m2[k] += seed.bound_m2[k];
  for (const KeptPair& pair : seed.pairs) worst_pairs.offer(pair);
}

std::vector<double> RunCurves::bound_m() const {
  std::vector<double> bound;
  for (const double sum_m2 : bound_m2) bound.push_back(std::sqrt(sum_m2 / static_cast<double>(seeds)));
  return bound;
}

/// The first seed's map.
std::string RunPictures::map_of(const RunResult& result, const std::vector<worlds::Wall>& walls) const {
  MapPicture picture = curves_.first.map.value_or(MapPicture{});
  picture.title = fmt::format("{}, seed {}{}", result.name, curves_.first.seed, alignment_note(result));
  picture.walls = walls;
  return draw_map_picture(picture);
}

std::string RunPictures::errors_of(const RunResult& result) const {
  const ErrorPicture picture{
      .title = fmt::format("{}: position error{}, {} seed{}", result.name, alignment_note(result),
                           curves_.seeds, curves_.seeds == 1 ? "" : "s"),
      .time_s = curves_.first.time_s,
      .filters = curves_.errors,
      .bound_m = curves_.bound_m(),
      .anees = anees_of(result, curves_.first.time_s.size())};
  return draw_error_picture(picture);
}

void RunPictures::write(const std::filesystem::path& out, const RunResult& result,
                        const std::vector<worlds::Wall>& walls) const {
  write_file_atomically(out / "map.png", map_of(result, walls));
  write_file_atomically(out / "error.png", errors_of(result));
  if (!curves_.first.snapshots.empty()) prepare_output_folder(out / "frames");
  for (const Snapshot& snapshot : curves_.first.snapshots)
    write_file_atomically(
        out / "frames" / fmt::format("seed{}_step{:04}.png", curves_.first.seed, snapshot.step),
        snapshot.png);
}

RunOutput::RunOutput(std::filesystem::path out, RunTally tally)
    : out_(std::move(out)), tally_(std::move(tally)), steps_(out_ / "steps.csv") {
  steps_.append(steps_csv_header());
}

void RunOutput::add(const SeedResult& seed) {
  tally_.add(seed);
  seed_metrics_.add(seed);
  pictures_.add(seed);
  steps_.append(seed.csv);
  if (seed.detections_gz.empty()) return;
  if (!detections_) detections_.emplace(out_ / kDetections).append(gzip(detections_csv_header()));
  detections_->append(seed.detections_gz);
}

RunResult RunOutput::result() const {
  RunResult result = tally_.result();
  result.seed_metrics = seed_metrics_.metrics();
  return result;
}

void RunOutput::write(const RunResult& result, const std::vector<worlds::Wall>& walls,
                      const BesideResult& write_more) {
  steps_.move_into_place();
  if (detections_)
    detections_->move_into_place();
  else
    std::filesystem::remove(out_ / kDetections);  // of an earlier run with pictures
  pictures_.write(out_, result, walls);
  write_file_atomically(out_ / "timing.json",
                        timing_json(tally_.timing(), result.seeds.size()).dump(2) + "\n");
  if (result.made_from) write_file_atomically(out_ / kResolvedScenario, result.made_from->scenario);
  if (result.made_from && result.made_from->invocation)
    write_file_atomically(out_ / kInvocation, invocation_text(*result.made_from->invocation));
  if (write_more) write_more(result, pictures_.curves());
  write_file_atomically(out_ / "run.json", json_text(run_json(result)));
}

}  // namespace stereobench::harness
