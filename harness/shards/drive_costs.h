/// What drives cost, as it was measured: so that shards of like cost can be cut.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace stereobench::harness {

/// The file of a shard that says what its drives cost.
inline constexpr const char* kCostsFile = "costs.json";

/// The mean time of drives, by their kind: those of a kind differ in their seeds alone (DriveTask::kind).
class DriveCosts {
 public:
  void add(const std::string& kind, double seconds);
  /// The time that a drive of a kind takes, s. Of a kind that was not measured: the mean of all drives that
  /// were, or 1 where none was.
  double seconds(const std::string& kind) const;
  /// The content of costs.json.
  std::string json() const;

  /// ShardRecord::plan of the work of which one unit of each kind was measured; those are not done again.
  /// Empty: what was measured is done again where it is asked for.
  std::string measured_plan;

 private:
  struct Sum {
    double seconds = 0.0;
    std::size_t drives = 0;
  };
  std::map<std::string, Sum> sums_;
  Sum all_;

  friend DriveCosts read_costs(const std::filesystem::path& file);
};

/// Reads a costs.json.
/// @throws std::runtime_error "file: key: what was expected"
DriveCosts read_costs(const std::filesystem::path& file);

}  // namespace stereobench::harness
