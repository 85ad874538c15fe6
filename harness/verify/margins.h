/// How near what checks compare comes to their limits: below 1 nothing is said, above it a fault is.
#pragma once

#include <algorithm>
#include <map>
#include <string>

namespace stereobench::harness {

/// The greatest share of each limit that was reached.
class Margins {
 public:
  /// Compares a value, and keeps what share of the limit it is.
  /// @param limit > 0
  /// @return whether the value is beyond it; NaN is not
  bool is_beyond(const std::string& name, double value, double limit) {
    double& most = most_[name];
    most = std::max(most, value / limit);
    return value > limit;
  }

  void add(const Margins& others) {
    for (const auto& [name, share] : others.most_) is_beyond(name, share, 1.0);
  }

  /// Shares by the limit's name.
  const std::map<std::string, double>& most() const { return most_; }

 private:
  std::map<std::string, double> most_;
};

}  // namespace stereobench::harness
