/// Values that are drawn by name, and the log of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/randomisation.h"

namespace stereobench::worlds {

/// A value that was drawn, and what it was drawn from: everything between two bounds, all whole numbers
/// between them, or one of several names.
struct Draw {
  std::string key;  ///< e.g. "walls[2].shade"
  double value = 0.0;
  Range from;
  bool is_whole = false;
  std::vector<std::string> names;  ///< where there are some, the value is an index into them
};

/// Draws by name. What a name gives depends on the seed and that name alone: whatever else is drawn, or no
/// longer, changes nothing.
class KeyedSampler {
 public:
  explicit KeyedSampler(std::uint64_t seed) : seed_(seed) {}

  /// A number in [least, most), or the one there is.
  double number(const std::string& key, const Range& from, std::uint64_t attempt = 0);
  /// A whole number from `least` to `most`.
  int whole(const std::string& key, int least, int most, std::uint64_t attempt = 0);
  /// An index into names.
  std::size_t choice(const std::string& key, std::span<const std::string_view> names);

  /// How much has been drawn, to come back to.
  std::size_t size() const { return log_.size(); }
  /// Forgets what was drawn since: an attempt that came to nothing.
  void forget_from(std::size_t size) { log_.resize(size); }
  const std::vector<Draw>& log() const { return log_; }

 private:
  double uniform(std::string_view key, std::uint64_t attempt) const;

  std::uint64_t seed_;
  std::vector<Draw> log_;
};

}  // namespace stereobench::worlds
