// Values of `--set` that cannot be: each is refused in one line that blames the command line.
#include <gtest/gtest.h>

#include "tests/worlds/scenario/faults.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::worlds {
namespace {

class BadOverrides : public testing::TestWithParam<BadOverride> {};

// Catches: an override blamed on the file, an unknown key that is quietly added.
TEST_P(BadOverrides, AreBlamedOnTheCommandLine) {
  expect_blamed(GetParam(), complaint_about);
}
constexpr BadOverride kBadOverrides[] = {
    {"particles", "--set particles: expected key.path=value (got no =)"},
    {"=3", "--set : expected key.path=value (got an empty key)"},
    {"path..laps=3", "--set path..laps: expected key.path=value (got an empty key)"},
    {"path.laps.x=3", "--set path.laps.x: expected a path of keys (got one below a value)"},
    {"world.balls.0=3", "--set world.balls.0: expected an entry of the list, e.g. world.balls[0]"},
    {"path.lap=3", "--set path.lap: unknown key, did you mean laps?"},
    {"colour=3", "--set colour: unknown key"},
    {"rig.width_px=many", "--set rig.width_px: expected a whole number from 16 to 4096 (got many)"},
    {"rig.width_px=", "--set rig.width_px: expected a whole number from 16 to 4096 (got nothing)"},
    {"world.sky_rgb=[0, 1, 7]", "--set world.sky_rgb[2]: expected a number from 0 to 1 (got 7)"},
    {"camera=[1", "--set camera: expected a YAML value ("},
    {"path.radius_m=10000", "--set path.radius_m: expected at most"},
};
INSTANTIATE_TEST_SUITE_P(All, BadOverrides, testing::ValuesIn(kBadOverrides));

}  // namespace
}  // namespace stereobench::worlds
