// A collection of small pictures, and the files of folders.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include <fmt/format.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {

// Six drives of four frames: three seeds, each with a good and with a noisy camera. @return the file
inline std::filesystem::path write_collection(const TestFolder& folder, const std::string& more = "",
                                              const std::string& formats = "plain, tum") {
  return folder.write("small.yaml", fmt::format(R"(dataset: small
about: {{description: A test., licence: CC0-1.0}}
formats: [{}]
{}drives:
  - name: circle
    scenario: {}
    set: [rig.width_px=160, rig.height_px=120, rig.focal_px=140, path.laps=0.08]
    seeds: {{train: 0..1, test: 7}}
    variations: [{{name: good}}, {{name: noisy, set: [camera.noise_sd_levels=6]}}]
)",
                                                formats, more, scenario_path("ball_circle")));
}

// The bytes of all files by their place.
inline std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).generic_string()] = bytes_of(entry.path());
  return files;
}

// When each file was written.
inline std::map<std::string, std::filesystem::file_time_type> times_below(
    const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      times[entry.path().lexically_relative(folder).generic_string()] = entry.last_write_time();
  return times;
}

// Whether `sha256sum` finds every file of a folder's manifest as it is listed.
inline bool sha256sum_agrees(const std::filesystem::path& folder) {
  return std::system(
             fmt::format("cd '{}' && sha256sum --strict --quiet -c manifest-sha256.txt >/dev/null 2>&1",
                         folder.string())
                 .c_str()) == 0;
}

}  // namespace stereobench::harness
