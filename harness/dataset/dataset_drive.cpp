#include "harness/dataset/dataset_drive.h"

#include <array>
#include <iterator>

#include <fmt/format.h>

#include "harness/dataset/draws_file.h"
#include "harness/drive/shutter.h"
#include "harness/logs/measurement_log_writer.h"
#include "harness/types.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

std::optional<TakenPictures> pictures_of(const worlds::Scenario& scenario, std::uint64_t seed,
                                         std::size_t step) {
  const auto late_s = lateness_s(scenario.shutter, seed, step);
  if (!late_s) return {};
  return TakenPictures{*late_s, worlds::pose_near(scenario.path, step, *late_s),
                       worlds::pose_near(scenario.path, step, *late_s + scenario.shutter.right_delay_s)};
}

}  // namespace

DatasetDrive drive_of(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
                      const FrameChoice& frames, const TruthRequest& truth) {
  DatasetDrive drive = {.name = scenario.name,
                        .seed = seed,
                        .world = world,
                        .rig = scenario.rig,
                        .believed_rig = scenario.believed_rig,
                        .shutter = scenario.shutter,
                        .encoding = scenario.camera.encoding,
                        .steps = {},
                        .truth = truth,
                        .draws = draws_jsonl(scenario, std::array{seed})};
  for (std::size_t step = 0; step < scenario.path.size(); ++step) {
    drive.steps.push_back({scenario.path[step].stamp_ns, scenario.path[step].pose, {}});
    if (frames.has(step)) drive.steps.back().pictures = pictures_of(scenario, seed, step);
  }
  return drive;
}

std::vector<std::size_t> steps_with_pictures(const DatasetDrive& drive) {
  std::vector<std::size_t> steps;
  for (std::size_t step = 0; step < drive.steps.size(); ++step)
    if (drive.steps[step].pictures) steps.push_back(step);
  return steps;
}

double pairs_per_second(const DatasetDrive& drive) {
  const std::vector<std::size_t> taken = steps_with_pictures(drive);
  if (taken.size() < 2) return 0.0;
  const auto whole_ns = drive.steps[taken.back()].stamp_ns - drive.steps[taken.front()].stamp_ns;
  return static_cast<double>(taken.size() - 1) * static_cast<double>(kSecond_ns) /
         static_cast<double>(whole_ns);
}

std::string frames_csv(const DatasetDrive& drive) {
  std::string csv = kFramesHeader + std::string("\n");
  for (std::size_t step = 0; step < drive.steps.size(); ++step) {
    const std::optional<TakenPictures>& pictures = drive.steps[step].pictures;
    fmt::format_to(std::back_inserter(csv), "{},{},{},", step, seconds_of(drive.steps[step].stamp_ns),
                   pictures ? 1 : 0);
    if (!pictures) {
      csv += ",,,,,,\n";
      continue;
    }
    fmt::format_to(std::back_inserter(csv), "{}", pictures->late_s);
    for (const slam::Pose& pose : {pictures->world_from_robot, pictures->world_from_robot_right})
      fmt::format_to(std::back_inserter(csv), ",{},{},{}", pose.x_m, pose.y_m, pose.heading_rad);
    csv += "\n";
  }
  return csv;
}

}  // namespace stereobench::harness
