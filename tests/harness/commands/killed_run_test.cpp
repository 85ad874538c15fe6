/// Runs and sweeps that are killed in the middle, as machines do.
#include <chrono>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "slam/math/random.h"
#include "tests/harness/commands/processes.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

struct Work {
  std::string kind;
  std::string command;               ///< without --out
  std::vector<std::string> results;  ///< that must be the same, byte for byte
};
void PrintTo(const Work& work, std::ostream* out) {
  *out << work.kind;
}
class KilledWork : public testing::TestWithParam<Work> {};

std::string command_of(const Work& work, const std::filesystem::path& out) {
  return fmt::format("{} --out '{}' >/dev/null 2>'{}.err'", work.command, out.string(), out.string());
}

bool is_over(pid_t process) {
  return !is_alive(process);
}

/// Starts the work and kills it a random time after its start or, later, after its first answer.
/// @return whether it came to its end before
bool kill_somewhere(const Work& work, const std::filesystem::path& out, slam::RandomStream& random) {
  const pid_t process = start_stereobench(command_of(work, out));
  const auto steps = static_cast<int>(60.0 * random.uniform());
  for (int step = 0; step < steps && !is_over(process); ++step)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(process, SIGKILL);
  return exit_code_of(process) == 0;
}

std::uintmax_t size_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

// Killed again and again, and then left alone: the same bytes as undisturbed, nothing is left over, and what
// was finished was not done again (the store of drives only grows). Mutations: a store that begins anew; keys
// without the seed (each seed gets the first one's drive); seeds in the order in which they ended.
TEST_P(KilledWork, GoesOnWhereItWasToTheSameBytes) {
  const TestFolder scratch;
  const Work& work = GetParam();
  const auto whole = scratch.path() / "whole", broken = scratch.path() / "broken";
  ASSERT_EQ(exit_code_of(start_stereobench(command_of(work, whole))), 0) << bytes_of(whole.string() + ".err");
  slam::RandomStream random(7, slam::Stream::kWorld);
  std::uintmax_t kept = 0;
  int kills = 0;
  for (; kills < 25 && !kill_somewhere(work, broken, random); ++kills) {
    const std::uintmax_t now = size_of(broken / "unfinished.drives");
    if (std::filesystem::exists(broken / work.results.front()))
      continue;                                            // all was done but for the clean-up
    EXPECT_GE(now + 1'000'000, kept) << "kill " << kills;  // a torn record may be dropped
    kept = std::max(kept, now);
  }
  ASSERT_EQ(exit_code_of(start_stereobench(command_of(work, broken))), 0)
      << bytes_of(broken.string() + ".err");
  for (const std::string& result : work.results)
    EXPECT_TRUE(bytes_of(whole / result) == bytes_of(broken / result)) << result << " after " << kills;
  EXPECT_FALSE(std::filesystem::exists(broken / "unfinished.drives"));
  for (const auto& entry : std::filesystem::directory_iterator(broken))
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

const std::string kField = scenario_path("open_field");
const std::string kCircle = scenario_path("ball_circle");

INSTANTIATE_TEST_SUITE_P(
    All, KilledWork,
    testing::Values(
        Work{"Run",
             "run '" + kField + "' --set gates=[] --particles 30 --seeds 0..7 --jobs 2",
             {"run.json", "steps.csv", "map.png", "error.png", "resolved_scenario.yaml"}},
        Work{"RunWithPictures",
             "run '" + kCircle + "' --set path.laps=0.1 --set gates=[] --particles 5 --seeds 3,0,2 --jobs 2",
             {"run.json", "steps.csv", "detections.csv.gz", "map.png", "frames/seed3_step0000.png"}},
        Work{"Sweep",
             "sweep '" + kField +
                 "' --set gates=[] --vary oracle.range_sd_m=0.1,0.2 --particles 20 --seeds 0..3 --jobs 2",
             {"sweep.json", "sweep.csv", "sweep.png"}}),
    [](const auto& test) { return test.param.kind; });

/// A run of one slow seed after three quick ones is killed in the slow one.
std::filesystem::path killed_run(const TestFolder& scratch, const std::string& more) {
  const auto out = scratch.path() / "out";
  const Work work{"", "run '" + kField + "' --particles 30 --seeds 0..99 --jobs 1 " + more, {}};
  const pid_t process = start_stereobench(command_of(work, out));
  EXPECT_TRUE(comes_true_in_time([&] { return size_of(out / "unfinished.drives") > 1'000'000; }));
  ::kill(process, SIGKILL);
  exit_code_of(process);
  return out;
}

Outcome run_field(const std::filesystem::path& out, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"run", kField, "--particles", "30", "--out", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_stereobench(arguments);
}

// What was kept is taken for what it is: another seed, filter or line of the scenario is driven anew, gates
// are no reason to. Mutations: keys without the scenario's lines; keys with its gates.
TEST(KeptDrives, AreTakenOverByTheSameScenarioAlone) {
  const TestFolder scratch;
  const auto out = killed_run(scratch, "");
  const auto copy_of_out = [&](const char* name) {
    const auto copy = scratch.path() / name;
    std::filesystem::copy(out, copy, std::filesystem::copy_options::recursive);
    return copy;
  };
  EXPECT_THAT(run_field(copy_of_out("same"), {"--seeds", "0"}).err,
              HasSubstr("1 of 1 drives were done before"));
  EXPECT_THAT(run_field(copy_of_out("gates"), {"--seeds", "0,100", "--set", "gates=[]"}).err,
              HasSubstr("1 of 2 drives were done before"));
  EXPECT_EQ(run_field(copy_of_out("seed"), {"--seeds", "100"}).err, "");
  EXPECT_EQ(run_field(copy_of_out("line"), {"--seeds", "0", "--set", "oracle.range_sd_m=0.31"}).err, "");
  EXPECT_EQ(run_field(copy_of_out("filter"), {"--seeds", "0", "--filters", "ekf"}).err, "");
}

TEST(KeptDrives, AreSaidToBeKept) {
  const TestFolder scratch;
  const auto out = scratch.path() / "out";
  const Work work{"", "run '" + kField + "' --particles 30 --seeds 0..99 --jobs 1", {}};
  const pid_t process = start_stereobench(command_of(work, out));
  EXPECT_TRUE(comes_true_in_time([&] { return size_of(out / "unfinished.drives") > 0; }));
  ::kill(process, SIGTERM);
  EXPECT_EQ(exit_code_of(process), 143);
  EXPECT_THAT(bytes_of(out.string() + ".err"), HasSubstr("what is finished is kept, and the same command"));
}

}  // namespace
}  // namespace stereobench::harness
