#include "harness/dataset/frames_file.h"

#include <iterator>

#include <fmt/format.h>

#include "harness/drive/shutter.h"
#include "harness/logs/measurement_log_writer.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {

std::vector<TakenPictures> pictures_of(const worlds::Scenario& scenario, std::uint64_t seed,
                                       const FrameChoice& frames) {
  std::vector<TakenPictures> taken;
  for (std::size_t step = 0; step < scenario.path.size(); ++step) {
    if (!frames.has(step)) continue;
    if (const auto late_s = lateness_s(scenario.shutter, seed, step))
      taken.push_back({step, *late_s, worlds::pose_near(scenario.path, step, *late_s)});
  }
  return taken;
}

std::string frames_csv(const worlds::Scenario& scenario, std::uint64_t seed, const FrameChoice& frames) {
  std::string csv = "step,t_s,has_pictures,late_s,x_m,y_m,theta_rad\n";
  const std::vector<TakenPictures> taken = pictures_of(scenario, seed, frames);
  auto next = taken.begin();
  for (std::size_t step = 0; step < scenario.path.size(); ++step) {
    const bool has_pictures = next != taken.end() && next->step == step;
    fmt::format_to(std::back_inserter(csv), "{},{},{},", step, seconds_of(scenario.path[step].stamp_ns),
                   has_pictures ? 1 : 0);
    if (has_pictures) {
      const slam::Pose& pose = next->world_from_robot;
      fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", next->late_s, pose.x_m, pose.y_m,
                     pose.heading_rad);
      ++next;
    } else {
      csv += ",,,\n";
    }
  }
  return csv;
}

}  // namespace stereobench::harness
