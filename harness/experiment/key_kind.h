/// What kind of value a key of scenario files takes.
#pragma once

#include <string_view>

namespace stereobench::harness {

/// @param path groups and key, joined by dots, e.g. "detector_noise.latency_frames"
/// @return whether it is a key of whole numbers
bool takes_whole_numbers(std::string_view path);

}  // namespace stereobench::harness
