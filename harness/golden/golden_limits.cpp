#include "harness/golden/golden_limits.h"

#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "worlds/yaml/advice.h"

namespace stereobench::harness {

std::span<const GoldenPreset> golden_presets() {
  static constexpr std::array<GoldenPreset, 3> kPresets = {{
      {"exact", {.levels = 0, .share = 0.0}, "no change is meant: same pixels, noise included"},
      {"rounding",
       {.levels = 1, .share = 0.0},
       "the same arithmetic in another order: light rounds to the next level"},
      {"edges",
       {.levels = 1, .share = 0.02},
       "another way to draw edges: pixels on the outlines of things, one in fifty, may be of any colour"},
  }};
  return kPresets;
}

GoldenLimits golden_limits(std::string_view name) {
  std::vector<std::string_view> names;
  for (const GoldenPreset& preset : golden_presets()) {
    if (preset.name == name) return preset.limits;
    names.push_back(preset.name);
  }
  throw std::runtime_error(
      fmt::format("no limits of golden pictures are called '{}', {}", name, worlds::advice(name, names)));
}

}  // namespace stereobench::harness
