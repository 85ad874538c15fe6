#include "harness/regression_commands/self_comparison.h"

#include <cstdlib>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "harness/commands/scenario_arguments.h"
#include "harness/frame_replay/frame_replay.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"
#include "harness/run/run_output.h"
#include "harness/run_command/run_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A new folder that is gone with the object.
class PassingFolder {
 public:
  PassingFolder() {
    std::string name = (fs::temp_directory_path() / "stereobench_again_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder in " + fs::temp_directory_path().string());
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void run_again(const Experiment& experiment, renderer::Backend backend, int jobs, const fs::path& out) {
  std::vector<DriveTask> tasks;
  for (const std::uint64_t seed : experiment.seeds)
    tasks.push_back({&experiment, seed, {.steps = true, .detections = true}, backend});
  RunOutput output(out, RunTally(experiment.scenario.name, rendered_by(experiment.scenario, backend)));
  drive_seeds(tasks, jobs, "again " + experiment.scenario.name,
              [&](std::size_t, const SeedResult& seed) { output.add(seed); });
  output.write(output.result(), {});
}

std::string metrics_of(const fs::path& folder) {
  nlohmann::json json = parse_line(read_text(folder / "run.json"));
  json.erase("made_from");
  json.erase("noise");
  return json.dump();
}

bool has_equal_bytes(const fs::path& first, const fs::path& second) {
  if (!fs::exists(first) || !fs::exists(second)) return fs::exists(first) == fs::exists(second);
  return read_text(first) == read_text(second);
}

}  // namespace

std::vector<std::string> differences_to_another_run(const fs::path& result, int jobs) {
  const Invocation invocation = read_invocation(result);
  renderer::MeshCache meshes;
  const Experiment experiment = experiment_of(invocation, meshes);
  const PassingFolder again;
  run_again(experiment, invocation.backend, jobs, again.path());
  std::vector<std::string> different;
  for (const char* file : {"steps.csv", "detections.csv.gz"})
    if (!has_equal_bytes(result / file, again.path() / file)) different.emplace_back(file);
  if (metrics_of(result) != metrics_of(again.path())) different.emplace_back("run.json");
  return different;
}

}  // namespace stereobench::harness
