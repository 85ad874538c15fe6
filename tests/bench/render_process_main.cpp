/// A process that renders and says how that went.
///
/// usage: stereobench_render_process SECONDS
/// Prints the numbers of a RenderReport.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "renderer/renderer.h"
#include "tests/bench/render_process.h"
#include "tests/bench/scenes.h"

namespace stereobench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A line of what the kernel says of this process, e.g. "VmHWM:", which it has in KiB.
double megabytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kib = 0.0; word == name && status >> kib) return 1024.0 * kib / 1e6;
  return 0.0;
}

RenderReport render_for(double seconds, Clock::time_point begin) {
  const Scene scene = eighteen_balls();
  renderer::Renderer renderer(scene.world, scene.rig);
  renderer.render(scene.pose);
  RenderReport report{.first_image_s = seconds_since(begin)};
  std::vector<double> pairs_s;
  const Clock::time_point first = Clock::now();
  while (seconds_since(first) < seconds) {
    const Clock::time_point start = Clock::now();
    renderer.render(scene.pose);
    pairs_s.push_back(seconds_since(start));
  }
  report.resident_mb = megabytes("VmHWM:");
  report.own_mb = megabytes("RssAnon:");
  if (pairs_s.empty()) return report;
  report.pairs_per_s = static_cast<double>(pairs_s.size()) / seconds_since(first);
  std::nth_element(pairs_s.begin(), pairs_s.begin() + std::ssize(pairs_s) / 2, pairs_s.end());
  report.pair_ms = 1e3 * pairs_s[pairs_s.size() / 2];
  return report;
}

}  // namespace

}  // namespace stereobench

int main(int argc, char** argv) {
  const auto begin = std::chrono::steady_clock::now();
  if (argc != 2) return 2;
  try {
    const stereobench::RenderReport report = stereobench::render_for(std::strtod(argv[1], nullptr), begin);
    fmt::print("{} {} {} {} {}\n", report.first_image_s, report.pair_ms, report.pairs_per_s,
               report.resident_mb, report.own_mb);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench_render_process: {}\n", error.what());
    return 1;
  }
}
