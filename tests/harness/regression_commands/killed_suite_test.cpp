/// Suites that are killed at any moment.
#include <chrono>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "slam/math/random.h"
#include "tests/harness/commands/processes.h"
#include "tests/harness/regression_commands/tiny_suite.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// The bytes of all files of a result but for those that say where and how long.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && !name.ends_with("timing.json") && !name.ends_with("places.json") &&
        !name.ends_with("invocation.json"))
      files[name] = bytes_of(entry.path());
  }
  return files;
}

// Mutations: a store that is removed before test.json is written (kills after it begin anew, and are never
// done); results of looks that depend on what was kept.
TEST(KilledSuite, GoesOnToTheSameBytes) {
  TinySuite suite(
      "  - {name: field, scenario: field.yaml}\n"
      "  - {name: room, scenario: room.yaml}\n"
      "  - {name: smooth, scenario: room.yaml, filters: [smoother]}\n");
  suite.test();
  suite.bless();
  ASSERT_EQ(suite.test().exit_code, 0);
  const auto whole = files_of(suite.path("out"));
  ASSERT_TRUE(whole.contains("test.json"));
  const std::string command = fmt::format("test '{}' --out '{}' --jobs 2 >/dev/null 2>&1",
                                          suite.path("tiny.yaml"), suite.path("killed"));
  slam::RandomStream random(23, slam::Stream::kWorld);
  int ends = 0;
  for (int kill = 0; kill < 100; ++kill) {
    const pid_t process = start_stereobench(command);
    const auto until = std::chrono::steady_clock::now() +
                       std::chrono::microseconds(static_cast<long>(4e5 * random.uniform()));
    while (is_alive(process) && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(process, SIGKILL);
    if (exit_code_of(process) != 0) continue;
    ++ends;
    EXPECT_TRUE(files_of(suite.path("killed")) == whole);
    fs::remove_all(suite.path("killed"));
  }
  ASSERT_EQ(exit_code_of(start_stereobench(command)), 0);
  EXPECT_TRUE(files_of(suite.path("killed")) == whole) << "after " << ends << " that came to their end";
}

}  // namespace
}  // namespace stereobench::harness
