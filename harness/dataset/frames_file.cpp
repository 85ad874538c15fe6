#include "harness/dataset/frames_file.h"

#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "harness/drive/shutter.h"
#include "harness/logs/measurement_log_writer.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {

std::string frames_csv(const worlds::Scenario& scenario, std::uint64_t seed, const FrameChoice& frames) {
  std::string csv = "step,t_s,has_pictures,late_s,x_m,y_m,theta_rad\n";
  for (std::size_t step = 0; step < scenario.path.size(); ++step) {
    const std::optional<double> late_s =
        frames.has(step) ? lateness_s(scenario.shutter, seed, step) : std::nullopt;
    fmt::format_to(std::back_inserter(csv), "{},{},{},", step, seconds_of(scenario.path[step].stamp_ns),
                   late_s ? 1 : 0);
    if (late_s) {
      const slam::Pose pose = worlds::pose_near(scenario.path, step, *late_s);
      fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", *late_s, pose.x_m, pose.y_m, pose.heading_rad);
    } else {
      csv += ",,,\n";
    }
  }
  return csv;
}

}  // namespace stereobench::harness
