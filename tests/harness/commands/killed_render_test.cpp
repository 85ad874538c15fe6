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

/// Starts the same in a shell's words that kill it; whether it was still at work.
bool kill_render(const std::filesystem::path& folder, const std::string& how) {
  std::string command = fmt::format("ulimit -c 0; {} '{}'", how, STEREOBENCH_PROGRAM);
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

// Killed again and again, a little later or in the middle of a file (the first one larger than so many blocks
// of 512 bytes: a picture, a map of depths): what has a final name is whole, byte for byte what an
// undisturbed rendering writes; and what comes to its end in the end is the same folder, with nothing left
// over. Mutations: files written under their own names; what a dead process left behind let be.
TEST(KilledRender, LeavesWholeFilesAndIsTakenUpWhereItWas) {
  const TestFolder scratch;
  const auto whole = scratch.path() / "whole", broken = scratch.path() / "broken";
  ASSERT_EQ(run_stereobench(render_to(whole)).exit_code, 0);
  const auto expected = files_of(whole);
  int killed = 0;
  for (const char* how : {"timeout -s KILL 0.15", "ulimit -f 2048; exec", "timeout -s KILL 0.5",
                          "ulimit -f 4096; exec", "timeout -s KILL 0.7"}) {
    killed += kill_render(broken, how) ? 1 : 0;
    if (!std::filesystem::exists(broken)) continue;
    for (const auto& [name, bytes] : files_of(broken))
      if (is_product(name)) {
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(bytes == expected.at(name), true) << name << " after " << how;
      }
  }
  EXPECT_GE(killed, 2);
  ASSERT_EQ(run_stereobench(render_to(broken)).exit_code, 0);
  const auto finished = files_of(broken);
  ASSERT_EQ(finished.size(), expected.size());
  for (const auto& [name, bytes] : expected)
    EXPECT_TRUE(finished.contains(name) && finished.at(name) == bytes) << name;
}

// Disks lose parts of files after they were written, too. Mutations: a manifest without hashes; hashes that
// `slam` does not look at.
TEST(FinishedRender, NoticesFilesThatLostAPart) {
  const TestFolder scratch;
  const auto data = scratch.path() / "data";
  ASSERT_EQ(run_stereobench(render_to(data)).exit_code, 0);
  const auto expected = files_of(data);
  std::filesystem::resize_file(data / "left/000001.png", 1000);
  std::filesystem::resize_file(data / "right_balls/000000.jsonl", 0);
  const std::string truth = expected.at("groundtruth.csv");
  std::filesystem::resize_file(data / "groundtruth.csv", truth.rfind('\n', truth.size() - 2) + 1);
  const Outcome slam = run_stereobench({"slam", data.string(), "--out", (scratch.path() / "slam").string()});
  EXPECT_EQ(slam.exit_code, 2);
  EXPECT_THAT(slam.err, testing::HasSubstr("groundtruth.csv: is not as it was rendered; run the same"));
  const Outcome again = run_stereobench(render_to(data));
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, testing::HasSubstr("3 files were missing or not as they had been written"));
  EXPECT_EQ(files_of(data), expected);
  EXPECT_EQ(run_stereobench(render_to(data)).err, "");
}

}  // namespace
}  // namespace stereobench::harness
