/// How single frames of a run are named.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stereobench::harness {

/// A stereo pair of a run: the seed, and the step of the path.
struct FrameName {
  std::uint64_t seed = 0;
  std::size_t step = 0;

  auto operator<=>(const FrameName&) const = default;
};

/// Reads "SEED:STEP", e.g. "3:120". @throws std::runtime_error that begins with "--frame: "
FrameName parse_frame_name(std::string_view text);

/// "seed3_step0120", as files of a frame are called.
std::string file_stem(const FrameName& frame);

}  // namespace stereobench::harness
