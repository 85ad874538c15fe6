#include "harness/experiment/stage_lines.h"

#include <set>

#include "harness/experiment/write_experiment.h"

namespace stereobench::harness {
namespace {

/// What no detector knows of. `identity` and `colour_spacing_m` are none of these: generators place balls by
/// them.
const std::set<std::string> kBehindDetector = {"name",
                                               "description",
                                               "seeds",
                                               "gates",
                                               "filters",
                                               "particles",
                                               "draw_every",
                                               "association",
                                               "detector_noise",
                                               "perfect_detections",
                                               "odometry_noise",
                                               "start_noise",
                                               "believed_oracle",
                                               "believed_odometry_noise",
                                               "believed_start_noise",
                                               "believed_measurement_noise"};

/// What a detector knows of, and no picture.
const std::set<std::string> kOfDetector = {"detector", "detector_timeout_s", "detector_start_s",
                                           "believed_rig"};

}  // namespace

std::string lines_of_sight(const std::string& scenario) {
  return without_keys(scenario, kBehindDetector);
}

std::string lines_of_pictures(const std::string& scenario) {
  std::set<std::string> keys = kBehindDetector;
  keys.insert(kOfDetector.begin(), kOfDetector.end());
  return without_keys(scenario, keys);
}

}  // namespace stereobench::harness
