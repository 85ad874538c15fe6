// A drive of odd numbers, rendered in the format plain and in another one, and the bytes of folders.
#pragma once

#include <fstream>
#include <functional>
#include <map>

#include "harness/dataset/drive_json.h"
#include "harness/dataset/seed_render.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {

inline std::map<std::string, std::string> bytes_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    files[std::filesystem::relative(entry.path(), folder).generic_string()] = {
        std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  return files;
}

/// A drive of odd numbers, rendered in the format plain, and in another one.
class RenderedTwice {
 public:
  /// @param change of the other one's pictures
  explicit RenderedTwice(
      const DatasetFormat& format, const std::string& truth = "balls,disparity,flow",
      TruthFormat truth_format = TruthFormat::kExact, const PictureChange& change = {},
      const std::function<void(worlds::Scenario&)>& alter = [](worlds::Scenario&) {}) {
    alter(experiment_.scenario);
    RenderTask task = {.experiment = &experiment_,
                       .seed = 3,
                       .frames = {},
                       .truth = {truth.empty() ? std::vector<TruthKind>() : parse_truth(truth), truth_format},
                       .datasets = {}};
    task.datasets = {
        {&dataset_formats().front(), folder("plain"), identity(task, dataset_formats().front(), {})}};
    render_seeds({task}, 1, "");
    task.change = change;
    task.datasets = {{&format, folder("rendered"), identity(task, format, change)}};
    render_seeds({task}, 1, "");
  }
  std::filesystem::path folder(const std::string& name) const { return folder_.path() / name; }
  const TestFolder& files() const { return folder_; }

 private:
  nlohmann::ordered_json identity(const RenderTask& task, const DatasetFormat& format,
                                  const PictureChange& change) const {
    const worlds::Scenario& scenario = experiment_.scenario;
    nlohmann::ordered_json json = {
        {"stereobench", STEREOBENCH_VERSION},
        {"seed", 3},
        {kDrive, drive_json(changed(drive_of(scenario, scenario.world, 3), change))}};
    if (change.changes_anything()) json[kPictures] = change_json(change);
    if (!is_plain(format)) {
      json["format"] = format.name;
      return json;
    }
    for (const TruthKind kind : task.truth.kinds) json["truth"].push_back(name_of(kind));
    if (task.truth.format != TruthFormat::kExact) json["truth_format"] = name_of(task.truth.format);
    return json;
  }
  static worlds::Scenario odd_drive() {
    worlds::Scenario scenario = tilted_drive();
    scenario.rig.intrinsics.focal_px = 140.1;
    scenario.rig.height_m = 0.31;
    scenario.believed_rig = scenario.rig;
    for (std::size_t i = 0; i < scenario.path.size(); ++i)
      scenario.path[i].pose.y_m = 0.1 / 3.0 * static_cast<double>(i);
    return scenario;
  }
  TestFolder folder_;
  Experiment experiment_ = {.scenario = odd_drive()};
};

}  // namespace stereobench::harness
