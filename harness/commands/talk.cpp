#include "harness/commands/talk.h"

#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/process/progress.h"
#include "harness/process/standard_streams.h"

namespace stereobench::harness {
namespace {

bool is_quiet = false;

void be_quiet() {
  is_quiet = true;
  silence_progress();
  if (std::freopen("/dev/null", "w", stdout) == nullptr)
    throw std::runtime_error("--quiet: no /dev/null here");
}

}  // namespace

void add_quiet_option(CLI::App& command) {
  command.add_flag_callback("--quiet,-q", be_quiet,
                            "say nothing but errors, warnings and broken gates; results are in files");
}

void say(std::string_view text) {
  fmt::print("{}", text);
  if (!is_quiet) return;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("warning: ")) note(line);
}

void say_gates(std::string_view report, bool broken) {
  fmt::print(is_quiet && broken ? stderr : stdout, "{}", report);
}

}  // namespace stereobench::harness
