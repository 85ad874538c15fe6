/// The grid of a sweep: each combination of the varied values is a cell.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// Lines of the scenario that vary together, and the values they take.
struct Variation {
  std::vector<std::string> keys;    ///< e.g. "camera.noise_sd_levels"; at least one
  std::vector<std::string> values;  ///< as the user wrote them, at least one; "0.1:1" is 0.1 for the first
                                    ///< key, 1 for the second

  /// The keys as one name: "oracle.range_sd_m:oracle.bearing_sd_deg".
  std::string name() const;
};

/// Reads "key=a,b,c", or "key:key=a:b,c:d" for lines that vary together.
/// @throws std::runtime_error that says what was expected: no key, no value, an empty or repeated value, a
///   value with another number of parts than there are keys
Variation parse_variation(const std::string& text);

/// One combination: the value of each variation, in their order.
using Cell = std::vector<std::string>;

/// All combinations, the last variation moving fastest.
/// @throws std::runtime_error when there are more than 10,000, or a key is varied twice
std::vector<Cell> grid(const std::vector<Variation>& variations);

/// A key of the scenario and what it is in one cell.
struct Setting {
  std::string key;
  std::string value;
};

/// What a cell sets: each key of each variation, in their order.
std::vector<Setting> settings_of(const std::vector<Variation>& variations, const Cell& cell);

/// What a cell sets, for people: "camera.gain = 2, path.laps = 1".
std::string name_of(const std::vector<Variation>& variations, const Cell& cell);

/// A cell as overrides of the scenario: "key=value" for each setting.
std::vector<std::string> overrides_of(const std::vector<Variation>& variations, const Cell& cell);

}  // namespace stereobench::harness
