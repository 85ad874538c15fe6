#include "harness/collection/render_tasks.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/drive_json.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/file_list.h"
#include "harness/run/provenance.h"
#include "renderer/backend.h"
#include "vision/observe.h"

namespace stereobench::harness {
namespace {

/// Of all seeds and formats.
nlohmann::ordered_json identity_of(const RenderRequest& request, const Experiment& experiment,
                                   const FrameChoice& frames) {
  const worlds::Scenario& scenario = experiment.scenario;
  std::ostringstream text;
  text << std::ifstream(request.scenario, std::ios::binary).rdbuf();
  const std::string& detector = experiment.detector.command;
  nlohmann::ordered_json identity = {
      {"schema", 3},
      {"stereobench", STEREOBENCH_VERSION},
      {"seed", nullptr},
      {"asked_frames", text_of(frames)},
      {"set", request.overrides},
      {"backend", renderer::name_of(request.backend)},
      {"detector", detector.empty() ? "stereobench" : detector},
      {"detector_files_sha256", files_of_command(detector)},
      {"scenario", text.str()},
      {"files_sha256", hashes_of_named_files(request.scenario, request.overrides)}};
  identity[kBallSize] = {{"radius_m", scenario.world.ball_radius_m()},
                         {"radius_sd_m", scenario.world.ball_radius_sd_m}};
  identity[kDrive] = drive_json(changed(drive_of(scenario, scenario.world, 0), request.change));
  if (scenario.rows_within_px != vision::ObserverSettings{}.rows_within_px)
    identity[kRowsWithin] = scenario.rows_within_px;
  if (request.change.changes_anything()) identity[kPictures] = change_json(request.change);
  return identity;
}

/// The same of one format's data set.
nlohmann::ordered_json identity_of(nlohmann::ordered_json identity, const RenderRequest& request,
                                   const DatasetFormat& format, std::uint64_t seed) {
  identity["seed"] = seed;
  if (!is_plain(format)) {
    identity["format"] = format.name;
    return identity;
  }
  for (const TruthKind kind : request.truth.kinds) identity["truth"].push_back(name_of(kind));
  if (request.truth.format != TruthFormat::kExact) identity["truth_format"] = name_of(request.truth.format);
  return identity;
}

}  // namespace

void check_request(const RenderRequest& request, const Experiment& experiment) {
  const worlds::Scenario& scenario = experiment.scenario;
  if (request.truth.format == TruthFormat::kKitti && request.truth.kinds.empty())
    throw std::runtime_error(
        "--truth-format kitti: is of disparity, match and flow; ask for them with --truth");
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format(
        "{}: its sensor is the oracle, which has no pictures to render; set sensor.kind to stereo",
        request.scenario.string()));
  const DatasetDrive drive =
      changed(drive_of(scenario, scenario.world, 0, request.frames, request.truth), request.change);
  for (const DatasetFormat* format : request.formats) check_format(*format, drive);
  const bool has_plain =
      std::ranges::any_of(request.formats, [](const DatasetFormat* format) { return is_plain(*format); });
  if (!has_plain && !request.truth.kinds.empty())
    throw std::runtime_error(
        fmt::format("--truth: {} has a place for what is its own alone; add the format {}",
                    request.formats.front()->name, dataset_formats().front().name));
}

std::vector<RenderTask> render_tasks(const RenderRequest& request, const Experiment& experiment,
                                     const std::vector<std::uint64_t>& seeds,
                                     const std::filesystem::path& out, bool has_seed_folders) {
  const FrameChoice frames = frames_of_drive(request.frames, experiment.scenario.path.size());
  const nlohmann::ordered_json identity = identity_of(request, experiment, frames);
  std::vector<RenderTask> tasks;
  for (const std::uint64_t seed : seeds) {
    tasks.push_back({.experiment = &experiment,
                     .seed = seed,
                     .frames = frames,
                     .truth = request.truth,
                     .backend = request.backend,
                     .datasets = {},
                     .change = request.change});
    for (const DatasetFormat* format : request.formats) {
      const std::filesystem::path folder = folder_of(out, *format, request.formats);
      tasks.back().datasets.push_back({format,
                                       has_seed_folders ? folder / fmt::format("seed_{}", seed) : folder,
                                       identity_of(identity, request, *format, seed)});
    }
  }
  return tasks;
}

}  // namespace stereobench::harness
