/// Scenario files as worlds alone read them. What they say of a run is left to the reader of the harness.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "tests/complaint.h"
#include "worlds/scenario/scenario.h"
#include "worlds/scenario/write_scenario.h"

namespace stereobench::worlds {

/// The keys at the top of scenario files that the harness declares (tests/harness/experiment checks the
/// list).
inline constexpr std::array kKeysOfRuns = {"filters",
                                           "particles",
                                           "draw_every",
                                           "seeds",
                                           "gates",
                                           "association",
                                           "detector",
                                           "detector_timeout_s",
                                           "detector_start_s",
                                           "detector_noise",
                                           "faults",
                                           "perfect_detections",
                                           "believed_oracle",
                                           "believed_odometry_noise",
                                           "believed_start_noise",
                                           "believed_measurement_noise"};

/// A scenario file without those keys.
inline YamlDocument load_scenario(const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides) {
  YamlDocument document = load_yaml(file, overrides, scenario_keys());
  for (const char* const key : kKeysOfRuns) document.root.remove(key);
  return document;
}

/// @throws std::runtime_error, std::invalid_argument as harness::read_experiment
inline Scenario read_scenario(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides = {},
                              const OccluderReader& occluders = {}) {
  const YamlDocument document = load_scenario(file, overrides);
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, scenario_keys());
  Scenario scenario = scenario_keys().read(top);
  read_world_and_path(YamlMap(top, scenario_keys()), occluders, scenario);
  return scenario;
}

/// The lines of a scenario file with its world written out (write_world).
inline std::string written_out(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {},
                               std::optional<std::uint64_t> seed = std::nullopt,
                               const OccluderReader& occluders = {}) {
  YamlDocument document = load_scenario(file, overrides);
  write_world(read_scenario(file, overrides, occluders), seed, document);
  YAML::Emitter text;
  text << document.root;
  return std::string(text.c_str()) + "\n";
}

/// What reading a file is refused with.
inline std::string complaint_about(const std::filesystem::path& file,
                                   const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { read_scenario(file, overrides); });
}

}  // namespace stereobench::worlds
