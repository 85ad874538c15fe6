/// How far long work has come, for people: a line on a terminal, nothing when piped.
#pragma once

#include <chrono>
#include <string>

namespace stereobench::harness {

/// One line on standard error that is redrawn in place while work goes on. Silent unless standard error
/// is a terminal.
class Progress {
 public:
  /// @param what is being done, e.g. "run ball_circle"
  /// @param total how much there is to do, > 0
  Progress(std::string what, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done in [0, total]
  void show(double done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double total_;
  bool on_terminal_;
  Clock::time_point started_;
  Clock::time_point drawn_;
};

}  // namespace stereobench::harness
