/// Command lines that begin with a scenario.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "harness/commands/arguments.h"
#include "harness/drive/recording.h"
#include "harness/experiment/types.h"
#include "renderer/surfaces/mesh_cache.h"
#include "worlds/drive/wall_crossings.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A scenario file and what the command line changes of it.
struct ScenarioArguments {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;  ///< "key.path=value"
  RunArguments run;
  renderer::Backend backend = renderer::Backend::kSoftware;
  std::string detector;                    ///< command of a program; empty: as the scenario says
  double detector_timeout_s = 0.0;         ///< 0: as the scenario says
  std::optional<double> detector_start_s;  ///< none: as the scenario says
  /// What was read of mesh files, by whoever asked.
  std::shared_ptr<renderer::MeshCache> meshes = std::make_shared<renderer::MeshCache>();
};

/// Adds SCENARIO, --set, --backend, --detector and its times.
void add_camera_options(CLI::App& command, ScenarioArguments& arguments);

/// Adds those and the options of a run.
void add_scenario_options(CLI::App& command, ScenarioArguments& arguments);

/// Reads the scenario and lets the command line have the last word on filters, particles and seeds.
/// @throws std::runtime_error as the reader of files does
Experiment read_experiment(const ScenarioArguments& arguments,
                           const std::vector<std::string>& more_overrides = {});

/// What is to be done, for --dry-run: "seeds 0, 1 of 145 steps each with ufastslam (100 particles)".
std::string work_of(const Experiment& experiment);

/// Says on standard error where the drive goes through a wall, or through a mesh; nothing where it does not.
void warn_of_crossings(std::span<const worlds::Crossing> crossings);

/// Says on standard error how coarse motion blur is, where points move by more than a pixel between two of
/// the instants that it is made of.
void warn_of_blur(const worlds::Shutter& shutter, const CoarseBlur& blur);

/// Says on standard error which textures are grey since they are nowhere, a line for each mesh file; nothing
/// where the scenario does not allow it, which is an error later.
/// @throws std::runtime_error as MeshCache::missing_textures
void warn_of_missing_textures(const worlds::Scenario& scenario, renderer::MeshCache& meshes);

/// What run.json says of who rendered: the back end's name, or "none" for a sensor without pixels.
std::string rendered_by(const worlds::Scenario& scenario, renderer::Backend backend);

}  // namespace stereobench::harness
