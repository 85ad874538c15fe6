#include "harness/run/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {

Progress::Progress(std::string what, double total)
    : what_(std::move(what)),
      total_(total),
      on_terminal_(::isatty(STDERR_FILENO) == 1),
      started_(Clock::now()) {}

Progress::~Progress() {
  if (on_terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(double done) {
  constexpr std::chrono::milliseconds kRedraw(100);
  const Clock::time_point now = Clock::now();
  if (!on_terminal_ || now - drawn_ < kRedraw) return;
  drawn_ = now;
  const double fraction = std::clamp(done / total_, 0.0, 1.0);
  const double elapsed_s = std::chrono::duration<double>(now - started_).count();
  const std::string left =
      fraction > 0.02 ? fmt::format(", {:.0f} s left", elapsed_s * (1.0 / fraction - 1.0)) : "";
  constexpr int kWidth = 30;
  const auto filled = static_cast<std::size_t>(fraction * kWidth);
  fmt::print(stderr, "\r\033[K{} [{:-<{}}] {:3.0f} %{}", what_, std::string(filled, '#'), kWidth,
             100.0 * fraction, left);
  std::fflush(stderr);
}

}  // namespace stereobench::harness
