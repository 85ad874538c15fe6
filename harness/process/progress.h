/// How far long work has come, for people: a line that is redrawn on a terminal, a line a minute elsewhere.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace stereobench::harness {

/// Where progress is shown, and the clock that it goes by.
struct ProgressOutput {
  using Clock = std::chrono::steady_clock;
  bool is_terminal = false;
  std::function<void(const std::string&)> write;
  std::function<Clock::time_point()> now = Clock::now;
};

/// Standard error; nothing at all once `silence_progress` was called.
ProgressOutput standard_progress();

/// Shows no progress from now on.
void silence_progress();

/// On a terminal one line that is redrawn in place while work goes on; in a file or pipe a line a minute, so
/// that a log shows a long run to be alive.
class Progress {
 public:
  /// @param what is being done, e.g. "run ball_circle"
  /// @param total how much there is to do, > 0
  Progress(std::string what, double total, ProgressOutput output = standard_progress());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done in [0, total]
  void show(double done);

 private:
  using Clock = ProgressOutput::Clock;
  std::string what_;
  double total_;
  ProgressOutput output_;
  Clock::time_point started_;
  Clock::time_point drawn_;
};

}  // namespace stereobench::harness
