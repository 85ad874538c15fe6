/// Collections whose rendering is killed, or whose disk is full.
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mount.h>

#include "slam/math/random.h"
#include "tests/harness/collection/small_collection.h"
#include "tests/harness/commands/processes.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// How many kills or disk sizes; STEREOBENCH_DATASET_KILLS=100 asks for more than a quick run has.
int trials(int usual) {
  const char* wanted = std::getenv("STEREOBENCH_DATASET_KILLS");
  return wanted == nullptr ? usual : std::atoi(wanted);
}

std::string command_to(const fs::path& file, const fs::path& out) {
  return fmt::format("dataset '{}' --jobs 2 --out '{}' >/dev/null 2>'{}.err'", file.string(), out.string(),
                     out.string());
}

/// A collection in one piece.
std::map<std::string, std::string> whole_collection(const TestFolder& scratch, const fs::path& file) {
  const fs::path whole = scratch.path() / "whole";
  EXPECT_EQ(exit_code_of(start_stereobench(command_to(file, whole))), 0) << bytes_of(whole.string() + ".err");
  return files_below(whole);
}

/// Whatever has a final name is whole, byte for byte; without a manifest at the top nothing is promised.
void expect_whole_files(const fs::path& folder, const std::map<std::string, std::string>& expected) {
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();  // relative() wants it there
    // A drive's process may outlive its killed parent: what has no final name may be gone by now.
    if (name.ends_with(".tmp") || name.ends_with("dataset.unfinished.json")) continue;
    if (name.find("/dataset.parts") != std::string::npos) continue;  // of a container
    if (!entry.is_regular_file()) continue;
    const auto found = expected.find(name);
    EXPECT_TRUE(found != expected.end() && found->second == bytes_of(entry.path())) << name;
  }
}

class KilledDataset : public testing::TestWithParam<const char*> {};

// Killed at random times, with two processes at work: what has a final name is whole, no file is lost, and in
// the end there is the same folder as of an undisturbed run, with nothing left over, parts of containers
// neither.
TEST_P(KilledDataset, EndsInTheSameFolder) {
  const TestFolder scratch;
  const fs::path file = write_collection(scratch, "", GetParam()), broken = scratch.path() / "broken";
  const auto expected = whole_collection(scratch, file);
  slam::RandomStream random(11, slam::Stream::kWorld);
  int kills = 0;
  for (int trial = 0; trial < trials(8); ++trial) {
    const pid_t process = start_stereobench(command_to(file, broken));
    const auto wait_ms = static_cast<int>(40.0 + 400.0 * random.uniform());
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ::kill(process, SIGKILL);
    if (exit_code_of(process) == 0) {  // it came to its end: begin anew
      EXPECT_TRUE(files_below(broken) == expected);
      fs::remove_all(broken);
      continue;
    }
    ++kills;
    expect_whole_files(broken, expected);
  }
  EXPECT_GE(kills, 2);
  ASSERT_EQ(exit_code_of(start_stereobench(command_to(file, broken))), 0);
  EXPECT_TRUE(files_below(broken) == expected);
}

INSTANTIATE_TEST_SUITE_P(Formats, KilledDataset, testing::Values("plain, tum", "rosbag, webdataset"));

/// A file system of so many bytes in memory, where the machine lets one be mounted.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& folder) : folder_(folder) { fs::create_directories(folder); }
  ~SmallDisk() {
    if (is_mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mount() {
    is_mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=4k") == 0;
    return is_mounted_;
  }
  /// Makes room, or takes it away where it is free.
  bool resize(std::uintmax_t bytes) const {
    return ::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, fmt::format("size={}", bytes).c_str()) == 0;
  }

 private:
  fs::path folder_;
  bool is_mounted_ = false;
};

// The disk is full again and again, a little later each time: one line, exit code 2, no file in part; with
// room it goes on, to the same folder. Mutation: a write's error let be.
TEST(FullDisk, IsOneLineAndGoesOnWithRoom) {
  const TestFolder scratch;
  const fs::path file = write_collection(scratch), disk = scratch.path() / "disk";
  const auto expected = whole_collection(scratch, file);
  std::uintmax_t bytes = 0;
  for (const auto& [name, content] : expected) bytes += (content.size() / 4096 + 1) * 4096;
  SmallDisk small(disk);
  if (!small.mount()) GTEST_SKIP() << "no file system can be mounted here";
  const fs::path out = disk / "set";
  int full = 0;
  const int places = trials(6);
  for (int place = 1; place <= places; ++place) {
    const auto share = static_cast<std::uintmax_t>(place);
    ASSERT_TRUE(small.resize(bytes * share / static_cast<std::uintmax_t>(places + 1)));
    const Outcome outcome = run_stereobench({"dataset", file.string(), "--out", out.string(), "--jobs", "2"});
    if (outcome.exit_code == 0) continue;
    ++full;
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("No space left on device"));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    expect_whole_files(out, expected);
    if (!fs::exists(out)) continue;
    for (const auto& [name, content] : files_below(out)) EXPECT_FALSE(name.ends_with(".tmp")) << name;
  }
  EXPECT_GE(full, places / 2);
  ASSERT_TRUE(small.resize(2 * bytes + (1U << 20U)));
  const Outcome last = run_stereobench({"dataset", file.string(), "--out", out.string(), "--jobs", "2"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_TRUE(files_below(out) == expected);
}

// A link does not lead to another file system. Mutation: copies that nobody writes.
TEST(MergedOntoAnotherDisk, IsCopied) {
  const TestFolder scratch;
  const fs::path file = write_collection(scratch), disk = scratch.path() / "disk";
  const auto expected = whole_collection(scratch, file);
  SmallDisk other(disk);
  if (!other.mount() || !other.resize(1U << 27U)) GTEST_SKIP() << "no file system can be mounted here";
  const Outcome outcome =
      run_stereobench({"merge", (scratch.path() / "whole").string(), "--out", (disk / "merged").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(files_below(disk / "merged") == expected);
}

}  // namespace
}  // namespace stereobench::harness
