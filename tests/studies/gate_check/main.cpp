/// Holds the gates of shipped scenarios against results of `run`: each within three standard errors.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/experiment.h"
#include "harness/io/text_file.h"
#include "harness/regression/gates.h"
#include "renderer/surfaces/mesh_cache.h"
#include "tests/harness/regression/gate_distance.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kBadUsage = 2;

/// @return how many gates are broken or too far
long check_result(const fs::path& folder, const fs::path& scenarios, renderer::MeshCache& meshes) {
  const Json run = Json::parse(read_text(folder / "run.json"));
  const fs::path file = scenarios / (run.at("scenario").get<std::string>() + ".yaml");
  const Experiment experiment = read_experiment(file, {}, meshes.occluders());
  if (run.at("seeds").get<std::vector<std::uint64_t>>() != experiment.seeds)
    throw std::runtime_error(
        fmt::format("{}: expected a result of the seeds of {}", folder.string(), file.filename().string()));
  const std::vector<GateDistance> distances = gate_distances(run, gates_of(experiment));
  const long wrong = std::ranges::count_if(
      distances, [](const GateDistance& distance) { return distance.is_broken() || distance.is_far(); });
  fmt::print("{}: {} seeds\n{}{} of {} gates are broken or too far\n\n", experiment.scenario.name,
             experiment.seeds.size(), distance_table(distances), wrong, distances.size());
  return wrong;
}

}  // namespace
}  // namespace stereobench::harness

int main(int argc, char** argv) {
  using namespace stereobench;
  CLI::App program(
      "Whether each gate of a shipped scenario is within three standard errors of what is measured.");
  std::vector<std::filesystem::path> results;
  std::filesystem::path scenarios = STEREOBENCH_SOURCE_DIR "/assets/scenarios";
  program.add_option("results", results, "folders that `run` wrote, with the seeds of their scenario")
      ->required();
  program.add_option("--scenarios", scenarios, "folder of NAME.yaml, whose gates are checked")
      ->capture_default_str();
  program.footer(
      "Exit codes: 0 all gates are, 1 one is broken or too far, 2 bad input.\n\n"
      "Example: stereobench run assets/scenarios/office.yaml && stereobench_gate_check out/office");
  CLI11_PARSE(program, argc, argv);
  try {
    renderer::MeshCache meshes;
    long wrong = 0;
    for (const std::filesystem::path& result : results)
      wrong += harness::check_result(result, scenarios, meshes);
    return wrong > 0 ? 1 : 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench_gate_check: {}\n", error.what());
    return harness::kBadUsage;
  }
}
