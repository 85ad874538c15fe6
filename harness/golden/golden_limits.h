/// How far a picture may be from its golden one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stereobench::harness {

/// Limits of colours. What each pixel shows must be equal whatever they are.
struct GoldenLimits {
  int levels = 0;      ///< a channel may differ by so many, of 255
  double share = 0.0;  ///< of the pixels of each camera's picture, that may differ by more

  /// Whether nothing may differ: then the hash of what the detector sees must be equal, too.
  bool are_exact() const { return levels == 0 && share == 0.0; }
};

/// Limits by name.
struct GoldenPreset {
  std::string_view name;
  GoldenLimits limits;
  std::string_view reason;  ///< for which changes they are meant
};

/// All presets, the strictest first.
std::span<const GoldenPreset> golden_presets();

/// The limits of a preset. @throws std::runtime_error that lists the names there are
GoldenLimits golden_limits(std::string_view name);

}  // namespace stereobench::harness
