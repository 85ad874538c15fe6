/// Time taken by the stages of a run.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace stereobench::harness {

/// Adds the wall-clock seconds of calls to the entries of a table.
class Stopwatch {
 public:
  explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}

  /// @return what `call` returns; its duration is added to `seconds[stage]`
  template <typename Call>
  auto time(const std::string& stage, Call&& call) {
    const auto begin = std::chrono::steady_clock::now();
    auto result = call();
    seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

 private:
  std::map<std::string, double>& seconds_;
};

}  // namespace stereobench::harness
