/// Scenes and rigs that the renderer's tests share.
#pragma once

#include "slam/math/random.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::renderer::test {

/// A number in [low, high).
double between(slam::RandomStream& random, double low, double high);

/// A camera that is cheap to render, with an off-centre principal point so that mistakes of sign show.
vision::StereoRig small_rig();

/// A room of about 10 x 10 m with a free-standing wall and 18 balls of radius 3 to 25 cm, on and off the
/// floor.
worlds::World random_room(std::uint64_t seed);

/// A pose near the middle of the room, any heading.
slam::Pose random_pose(std::uint64_t seed);

/// Nothing but balls of one flat colour before a black sky, for a rig that looks up at them.
worlds::World flat_sky(std::vector<worlds::Ball> balls);
vision::StereoRig rig_looking_up();

}  // namespace stereobench::renderer::test
