/// Rendering in processes of their own: what is decided once a process (threads, caches), and what is a
/// process's (memory, the time until it has its first picture).
#pragma once

#include <cstdio>
#include <string>

namespace stereobench {

/// What such a process says of itself.
struct RenderReport {
  double first_image_s = 0.0;  ///< from its main() to the first pair
  double pair_ms = 0.0;        ///< of the pairs after it, the median
  double pairs_per_s = 0.0;
  double resident_mb = 0.0;  ///< at most, with the pages of libraries that all processes share
  double own_mb = 0.0;       ///< at the end, without them
};

/// A process that renders eighteen_balls. It begins at once.
class RenderProcess {
 public:
  /// @param environment e.g. "LP_NUM_THREADS=2"
  /// @param seconds how long it renders after the first pair
  RenderProcess(const std::string& environment, double seconds);
  ~RenderProcess();
  RenderProcess(const RenderProcess&) = delete;
  RenderProcess& operator=(const RenderProcess&) = delete;

  /// Waits for its end. @throws std::runtime_error when it fails
  RenderReport report();

 private:
  std::FILE* output_;
};

}  // namespace stereobench
