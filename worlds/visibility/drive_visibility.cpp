#include "worlds/visibility/drive_visibility.h"

#include <algorithm>

#include "worlds/visibility/visibility.h"

namespace stereobench::worlds {
namespace {

using Things = std::array<std::optional<Cone>, 2>;  // what is put somewhere, by camera

bool hidden(const Things& thing, const std::array<Cone, 2>& ball) {
  return hides(thing[0], ball[0]) || hides(thing[1], ball[1]);
}

}  // namespace

DriveVisibility::DriveVisibility(const Scenario& scenario, const World& world) {
  for (const PathStep& at : scenario.path) {
    Step step{{camera_pose(scenario.rig, vision::Side::kLeft, at.pose),
               camera_pose(scenario.rig, vision::Side::kRight, at.pose)},
              {}};
    for (const int index : balls_in_view(scenario, world, at.pose)) {
      const Ball& ball = world.balls[static_cast<std::size_t>(index)];
      const Sphere sphere{ball.centre_m, ball.radius_m};
      step.balls.push_back(
          {cone_around(step.cameras[0], sphere).value(), cone_around(step.cameras[1], sphere).value()});
    }
    steps_.push_back(std::move(step));
  }
}

bool DriveVisibility::allows(const Sphere& thing, int least) const {
  return std::ranges::all_of(steps_, [&](const Step& step) {
    const Things cones = {cone_around(step.cameras[0], thing), cone_around(step.cameras[1], thing)};
    const auto left =
        std::ranges::count_if(step.balls, [&](const Cones& ball) { return !hidden(cones, ball); });
    return left >= std::min<long>(least, std::ssize(step.balls));
  });
}

void DriveVisibility::put(const Sphere& thing) {
  for (Step& step : steps_) {
    const Things cones = {cone_around(step.cameras[0], thing), cone_around(step.cameras[1], thing)};
    std::erase_if(step.balls, [&](const Cones& ball) { return hidden(cones, ball); });
  }
}

}  // namespace stereobench::worlds
