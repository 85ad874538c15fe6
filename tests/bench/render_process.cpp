#include "tests/bench/render_process.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace stereobench {

RenderProcess::RenderProcess(const std::string& environment, double seconds)
    : output_(
          ::popen(fmt::format("{} {} {}", environment, STEREOBENCH_RENDER_PROCESS, seconds).c_str(), "r")) {
  if (output_ == nullptr) throw std::runtime_error("cannot start a process that renders");
}

RenderProcess::~RenderProcess() {
  if (output_ != nullptr) ::pclose(output_);
}

RenderReport RenderProcess::report() {
  RenderReport report;
  const int read = std::fscanf(output_, "%lf %lf %lf %lf %lf", &report.first_image_s, &report.pair_ms,
                               &report.pairs_per_s, &report.resident_mb, &report.own_mb);
  if (::pclose(std::exchange(output_, nullptr)) != 0 || read != 5)
    throw std::runtime_error("a process that renders has failed");
  return report;
}

}  // namespace stereobench
