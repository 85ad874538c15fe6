/// A rendering that is killed in the middle, as machines do.
#include <cstdlib>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

const std::vector<std::string> kRender = {
    "render", scenario_path("ball_circle"), "--set", "path.laps=0.1", "--truth", "surface,balls", "--out"};

std::vector<std::string> render_to(const std::filesystem::path& folder) {
  std::vector<std::string> words = kRender;
  words.push_back(folder.string());
  return words;
}

/// Starts the same and kills it after some time; whether it was still at work.
bool kill_render(const std::filesystem::path& folder, double after_s) {
  std::string command = fmt::format("timeout -s KILL {} '{}'", after_s, STEREOBENCH_PROGRAM);
  for (const std::string& word : render_to(folder)) command += " '" + word + "'";
  return std::system((command + " >/dev/null 2>&1").c_str()) != 0;
}

/// All files by their place in a folder.
std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  return files;
}

bool is_product(const std::string& name) {
  return name.ends_with(".png") || name.ends_with(".pfm") || name.ends_with(".jsonl") ||
         name.ends_with(".csv");
}

// Killed again and again, each time a little later: what has a final name is whole, byte for byte what an
// undisturbed rendering writes; and what comes to its end in the end is the same folder, with nothing left
// over. Meant to catch: files written under their own names.
TEST(KilledRender, LeavesWholeFilesAndIsTakenUpWhereItWas) {
  const ScratchFolder scratch;
  const auto whole = scratch.path() / "whole", broken = scratch.path() / "broken";
  ASSERT_EQ(run_stereobench(render_to(whole)).exit_code, 0);
  const auto expected = files_of(whole);
  int killed = 0;
  for (const double after_s : {0.15, 0.3, 0.5, 0.7}) {
    killed += kill_render(broken, after_s) ? 1 : 0;
    if (!std::filesystem::exists(broken)) continue;
    for (const auto& [name, bytes] : files_of(broken))
      if (is_product(name)) {
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(bytes == expected.at(name), true) << name << " after " << after_s << " s";
      }
  }
  EXPECT_GE(killed, 1);
  ASSERT_EQ(run_stereobench(render_to(broken)).exit_code, 0);
  const auto finished = files_of(broken);
  ASSERT_EQ(finished.size(), expected.size());
  for (const auto& [name, bytes] : expected)
    EXPECT_TRUE(finished.contains(name) && finished.at(name) == bytes) << name;
}

}  // namespace
}  // namespace stereobench::harness
