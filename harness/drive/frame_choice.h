/// Which frames of a drive are wanted.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stereobench::harness {

/// Every `stride`-th step of a drive, from the first one to the last one. Default: all of them.
struct FrameChoice {
  std::size_t first = 0;
  std::optional<std::size_t> last;  ///< included; none: the drive's last one
  std::size_t stride = 1;

  /// Whether a step's frame is among them.
  bool has(std::size_t step) const {
    return step >= first && (!last || step <= *last) && (step - first) % stride == 0;
  }
};

/// Reads "7", "0..90" (both ends included) or "0..90:10" (every tenth of them).
/// @throws std::runtime_error, one line that begins with "--frames: ", for anything else
FrameChoice parse_frames(std::string_view text);

/// The same frames of a certain drive, in the one form that names them: with a last frame that is one of
/// them.
/// @param steps of the drive, >= 1
/// @throws std::runtime_error, one line that says which frames the drive has, where it has not all of them
FrameChoice frames_of_drive(const FrameChoice& choice, std::size_t steps);

/// "0..90:10", as parse_frames reads it. @param choice as of frames_of_drive
std::string text_of(const FrameChoice& choice);

}  // namespace stereobench::harness
