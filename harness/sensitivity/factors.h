/// What a study varies: keys of the scenario within ranges, and streams of random numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stereobench::harness {

/// How values lie between the ends of a range.
enum class Spacing {
  kEven,         ///< uniform
  kLogarithmic,  ///< the logarithm is uniform; both ends > 0
  kWhole         ///< whole numbers, all as probable, both ends included
};

/// A key of the scenario, and between which values it lies. All of them are as probable.
struct KeyRange {
  std::string key;  ///< e.g. "oracle.range_sd_m"
  double low = 0.0;
  double high = 1.0;  ///< > low
  Spacing spacing = Spacing::kEven;
};

/// Reads "key=low..high", "key=low..high:log" or "key=low..high:whole".
/// @throws std::runtime_error with one line that says what was expected
KeyRange parse_key_range(const std::string& text);

/// @param share of the way from low to high, in [0, 1)
/// @return in [low, high]
double value_at(const KeyRange& range, double share);

/// Everything that a metric depends on in a study. A stream is a factor like a key: its value is a seed.
///
/// With keys there is usually one stream, the seed of a run, which stands for all that is chance. To see
/// which kind of chance matters, a study has several streams and no key.
struct Factors {
  std::vector<KeyRange> keys;
  std::vector<std::string> streams;  ///< by name, e.g. {"world", "odometry", "sensor", "filter"}

  std::size_t size() const { return keys.size() + streams.size(); }
  /// @param index keys first, then streams
  const std::string& name(std::size_t index) const;
  /// The values of a factor for people: "0.1 to 0.3", "1 to 100, logarithmic", "random numbers".
  std::string values(std::size_t index) const;
};

/// @throws std::runtime_error when there is no factor, or one stands twice
void check(const Factors& factors);

}  // namespace stereobench::harness
