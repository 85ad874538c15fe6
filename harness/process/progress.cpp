#include "harness/process/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

bool is_silent = false;

/// What is left, judged by what was done; empty while that is too little to judge by.
std::string time_left(double fraction, double elapsed_s) {
  return fraction > 0.02 ? fmt::format(", {:.0f} s left", elapsed_s * (1.0 / fraction - 1.0)) : "";
}

std::string bar(double fraction) {
  constexpr int kWidth = 30;
  const auto filled = static_cast<std::size_t>(fraction * kWidth);
  return fmt::format("[{:-<{}}]", std::string(filled, '#'), kWidth);
}

}  // namespace

ProgressOutput standard_progress() {
  ProgressOutput output;
  output.is_terminal = ::isatty(STDERR_FILENO) == 1;
  output.write = [](const std::string& text) {
    if (is_silent) return;
    fmt::print(stderr, "{}", text);
    std::fflush(stderr);
  };
  return output;
}

void silence_progress() {
  is_silent = true;
}

Progress::Progress(std::string what, double total, ProgressOutput output)
    : what_(std::move(what)),
      total_(total),
      output_(std::move(output)),
      started_(output_.now()),
      drawn_(output_.is_terminal ? Clock::time_point() : started_) {}

Progress::~Progress() {
  if (output_.is_terminal) output_.write("\r\033[K");
}

void Progress::show(double done) {
  constexpr std::chrono::milliseconds kRedraw(100);
  constexpr std::chrono::minutes kLine(1);
  const Clock::time_point now = output_.now();
  if (now - drawn_ < (output_.is_terminal ? Clock::duration(kRedraw) : Clock::duration(kLine))) return;
  drawn_ = now;
  const double fraction = std::clamp(done / total_, 0.0, 1.0);
  const std::string left = time_left(fraction, std::chrono::duration<double>(now - started_).count());
  if (output_.is_terminal)
    output_.write(fmt::format("\r\033[K{} {} {:3.0f} %{}", what_, bar(fraction), 100.0 * fraction, left));
  else
    output_.write(fmt::format("{}: {:.0f} %{}\n", what_, 100.0 * fraction, left));
}

}  // namespace stereobench::harness
