/// The grid of a sweep: each combination of the varied values is a cell.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// A line of the scenario and the values it takes.
struct Variation {
  std::string key;                  ///< e.g. "camera.noise_sd_levels"
  std::vector<std::string> values;  ///< as the user wrote them, at least one
};

/// Reads "key=a,b,c".
/// @throws std::runtime_error that says what was expected: no key, no value, an empty or repeated value
Variation parse_variation(const std::string& text);

/// One combination: the value of each variation, in their order.
using Cell = std::vector<std::string>;

/// All combinations, the last variation moving fastest.
/// @throws std::runtime_error when there are more than 10,000, or a key is varied twice
std::vector<Cell> grid(const std::vector<Variation>& variations);

/// A cell as overrides of the scenario: "key=value" for each variation.
std::vector<std::string> overrides_of(const std::vector<Variation>& variations, const Cell& cell);

}  // namespace stereobench::harness
