#include "harness/commands/kept_drives.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/stage_lines.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/noise_check/noise_check.h"
#include "harness/process/interruption.h"
#include "harness/process/process_pool.h"
#include "harness/process/standard_streams.h"
#include "renderer/backend.h"

namespace stereobench::harness {
namespace {

/// So that what is kept of a thousand seeds stays small.
constexpr std::size_t kPairsOfLaterSeeds = 4;

/// All that the command line says of a scenario, as lines of it.
std::vector<std::string> all_overrides(const ScenarioArguments& arguments,
                                       const std::vector<std::string>& more_overrides,
                                       const Experiment& experiment) {
  std::vector<std::string> overrides = arguments.overrides;
  overrides.insert(overrides.end(), more_overrides.begin(), more_overrides.end());
  overrides.push_back(fmt::format("filters=[{}]", fmt::join(experiment.filters, ", ")));
  overrides.push_back(fmt::format("particles={}", experiment.particles));
  overrides.push_back(fmt::format("seeds={}", fmt::join(experiment.seeds, ",")));
  if (experiment.detector.command.empty()) return overrides;
  overrides.push_back("detector=" + nlohmann::json(experiment.detector.command).dump());
  overrides.push_back(fmt::format("detector_timeout_s={}", experiment.detector.timeout_s));
  overrides.push_back(fmt::format("detector_start_s={}", experiment.detector.start_s));
  return overrides;
}

/// What drives are made from but for their seeds: each stage of the chain, see stage_lines.h.
struct Basis {
  std::string drive;
  std::string sight;     ///< what the detector answers; empty where looks are not shared
  std::string pictures;  ///< what it is shown; empty where `sight` is
};

Basis basis_of_drives(const ScenarioArguments& arguments, const std::vector<std::string>& more_overrides,
                      const Experiment& experiment, const std::string& pixels, bool shares_looks) {
  Experiment any_seed = experiment;
  any_seed.seeds = {0};
  std::vector<std::string> overrides = more_overrides;
  overrides.push_back("gates=[]");
  Provenance provenance = provenance_of(arguments, overrides, any_seed, pixels);
  const std::string lines = provenance.scenario;
  const std::string backend = renderer::name_of(arguments.backend);
  const auto basis_with = [&](const std::string& scenario, const std::string& detector) {
    provenance.scenario = scenario;
    return basis_of(provenance, backend, detector);
  };
  const std::string& detector = experiment.detector.command;
  const std::string drive = basis_with(lines, detector);
  if (!shares_looks) return {drive, {}, {}};
  return {drive, basis_with(lines_of_sight(lines), detector), basis_with(lines_of_pictures(lines), {})};
}

std::string key_of(const std::string& basis, const DriveTask& task) {
  const SeedParts& parts = task.parts;
  const StreamSeeds seeds = task.seeds();
  return sha256_of(
      fmt::format("{} seeds {} {} {} {} steps {} map {} snapshots {} log {} detections {} pairs {}", basis,
                  seeds.world, seeds.odometry, seeds.sensor, seeds.filter, parts.steps, parts.map,
                  parts.snapshots, parts.log, parts.detections, parts.pairs));
}

std::string key_of_look(const std::string& basis, const DriveTask& task) {
  return sha256_of(fmt::format("{} world {} sensor {}", basis, task.seeds().world, task.seeds().sensor));
}

bool needs_pictures(const SeedParts& parts) {
  return parts.detections || parts.snapshots > 0 || parts.pairs > 0;
}

}  // namespace

std::string pixels_of(const worlds::Scenario& scenario, renderer::Backend backend) {
  if (scenario.sensor != worlds::SensorKind::kStereo) return {};
  const Task look = [&](std::size_t, const auto&) {
    const renderer::TestFrame frame = renderer::render_test_frame(backend);
    return renderer::fingerprint(renderer::backend_info(backend), frame);
  };
  return run_in_processes(1, 1, look, [](double) {}).front();
}

Provenance provenance_of(const ScenarioArguments& arguments, const std::vector<std::string>& more_overrides,
                         const Experiment& experiment, const std::string& pixels) {
  const std::filesystem::path& file = arguments.scenario;
  const auto overrides = all_overrides(arguments, more_overrides, experiment);
  ScenarioLines lines = lines_and_files(file, overrides);
  Provenance provenance{.scenario = std::move(lines.text), .set = arguments.overrides};
  provenance.files = std::move(lines.files_sha256);
  provenance.invocation = Invocation{.scenario = std::filesystem::absolute(file),
                                     .overrides = overrides,
                                     .folder = std::filesystem::current_path(),
                                     .backend = arguments.backend};
  provenance.set.insert(provenance.set.end(), more_overrides.begin(), more_overrides.end());
  if (experiment.scenario.sensor == worlds::SensorKind::kStereo) provenance.pixels = pixels;
  return provenance;
}

std::vector<DriveTask> drive_tasks(const ScenarioArguments& arguments,
                                   const std::vector<std::string>& more_overrides,
                                   const Experiment& experiment, const std::string& pixels,
                                   const SeedParts& parts, const std::vector<StreamSeeds>& seeds) {
  const bool shares_looks =
      experiment.scenario.sensor == worlds::SensorKind::kStereo && !needs_pictures(parts);
  const Basis basis = basis_of_drives(arguments, more_overrides, experiment, pixels, shares_looks);
  const std::string kind = sha256_of(basis.drive);
  std::vector<DriveTask> tasks;
  for (const StreamSeeds& streams : seeds) {
    const bool is_first = tasks.empty();
    SeedParts wanted = parts;
    wanted.map = parts.map && is_first;
    wanted.snapshots = is_first ? parts.snapshots : 0;
    wanted.pairs = is_first ? parts.pairs : std::min(parts.pairs, kPairsOfLaterSeeds);
    wanted.log = parts.log && tasks.size() < kCheckedLogs;
    DriveTask& task = tasks.emplace_back(DriveTask{.experiment = &experiment,
                                                   .seed = streams.world,
                                                   .parts = wanted,
                                                   .backend = arguments.backend,
                                                   .streams = streams});
    task.key = key_of(basis.drive, task);
    task.kind = kind;
    if (!shares_looks) continue;
    task.sight = key_of_look(basis.sight, task);
    task.pictures = key_of_look(basis.pictures, task);
  }
  return tasks;
}

std::vector<DriveTask> drive_tasks(const ScenarioArguments& arguments,
                                   const std::vector<std::string>& more_overrides,
                                   const Experiment& experiment, const std::string& pixels,
                                   const SeedParts& parts) {
  const std::vector<StreamSeeds> seeds(experiment.seeds.begin(), experiment.seeds.end());
  return drive_tasks(arguments, more_overrides, experiment, pixels, parts, seeds);
}

void look_once(std::vector<DriveTask>& tasks) {
  std::map<std::string, int> sharers;
  for (const DriveTask& task : tasks) ++sharers[task.sight];
  for (DriveTask& task : tasks)
    if (sharers[task.sight] < 2) task.sight = task.pictures = {};
}

bool share_sight(const ScenarioArguments& base, const std::vector<std::string>& some,
                 const std::vector<std::string>& others) {
  const auto sight_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> overrides = base.overrides;
    overrides.insert(overrides.end(), more.begin(), more.end());
    return lines_of_sight(with_overrides(base.scenario, overrides));
  };
  return sight_with(some) == sight_with(others);
}

KeptDrives::KeptDrives(const std::filesystem::path& out) : store_(out / kDrivesFile) {
  remove_leftovers_in(out);
}

void KeptDrives::complete(const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                          const OnSeed& on_seed) {
  say_what_is_kept(tasks, what);
  drive_into(store_, tasks, jobs, what, on_seed);
}

std::map<std::string, std::string> KeptDrives::complete_groups(
    const std::vector<std::vector<DriveTask>>& groups, int jobs, const std::string& what) {
  std::vector<DriveTask> tasks;
  for (const std::vector<DriveTask>& group : groups) tasks.insert(tasks.end(), group.begin(), group.end());
  say_what_is_kept(tasks, what);
  return drive_groups(store_, groups, jobs, what);
}

void KeptDrives::hand_on(const std::vector<DriveTask>& tasks, const OnSeed& on_seed) const {
  for (std::size_t i = 0; i < tasks.size(); ++i)
    on_seed(i, seed_result_from_bytes(store_.read(tasks[i].key)));
}

void KeptDrives::say_what_is_kept(const std::vector<DriveTask>& tasks, const std::string& what) const {
  if (std::exchange(has_said_, true)) return;
  const auto kept =
      std::ranges::count_if(tasks, [&](const DriveTask& task) { return store_.holds(task.key); });
  const bool is_program = std::ranges::any_of(
      tasks, [](const DriveTask& task) { return !task.experiment->detector.command.empty(); });
  if (kept > 0)
    note(fmt::format("{}: {} of {} drives were done before, and are taken over{}", what, kept, tasks.size(),
                     is_program
                         ? "; if the detector reads other files than its command names, such as weights, "
                           "and they have changed since, remove " +
                               std::string(kDrivesFile) + " from the output folder and start again"
                         : ""));
  say_that_work_is_kept();
}

}  // namespace stereobench::harness
