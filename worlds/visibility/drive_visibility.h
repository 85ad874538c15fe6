/// What a drive sees, asked again and again: what would a thing hide that is put here?
#pragma once

#include <array>
#include <vector>

#include "worlds/visibility/view_cone.h"

namespace stereobench::worlds {

/// The balls in view at each step of a scenario's drive through a world.
class DriveVisibility {
 public:
  DriveVisibility(const Scenario& scenario, const World& world);

  /// Whether at each step `least` balls stay in view beside the thing, or all that are where there are fewer.
  bool allows(const Sphere& thing, int least) const;

  /// Puts the thing there: what it hides is no longer in view.
  void put(const Sphere& thing);

 private:
  using Cameras = std::array<CameraPose, 2>;
  using Cones = std::array<Cone, 2>;  // of a ball, by camera
  struct Step {
    Cameras cameras;
    std::vector<Cones> balls;
  };
  std::vector<Step> steps_;
};

}  // namespace stereobench::worlds
