/// Commands cut into shards, as a cluster runs them: the merged result is that of the whole command.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<std::string>;

/// Small pictures of a short way.
const Words kSmall = {"--set", "path.laps=0.05",    "--set", "rig.width_px=512",
                      "--set", "rig.height_px=384", "--set", "rig.focal_px=443"};

/// 20 m of the open field.
const Words kShortWay = {"--set", "path.points_m=[[-15, -18], [5, -18]]", "--set", "path.closed=false"};

struct Command {
  std::string name;
  Words words;
};
void PrintTo(const Command& command, std::ostream* out) {
  *out << command.name;
}

std::vector<Command> commands() {
  const std::string circle = scenario_path("ball_circle"), field = scenario_path("open_field");
  const Words brief = {"--filters", "ekf", "--set", "gates=[]"};
  return {
      {"run", with(with({"run", circle, "--seeds", "0..3"}, brief), kSmall)},
      {"sweep",
       with(with({"sweep", field, "--vary", "oracle.range_sd_m=0.1,0.2,0.4", "--seeds", "0..3"}, brief),
            kShortWay)},
      {"sweep_that_shares_pictures",
       with(with({"sweep", circle, "--vary", "detector_noise.centre_sd_px=0,1", "--seeds", "0..3"}, brief),
            kSmall)},
      {"adaptive_sweep", with(with({"sweep", field, "--vary", "oracle.range_sd_m=0.1,1,4", "--seeds", "0..3",
                                    "--adaptive", "1"},
                                   brief),
                              kShortWay)},
      {"attribute", with({"attribute", field, "--seeds", "0..2", "--filters", "ekf"}, kShortWay)},
      {"budget", with({"budget", field, "--vary", "oracle.range_sd_m=0.1..3", "--metric",
                       "filters.ekf.ate_rms_m", "--limit", "0.1", "--share", "0.7", "--confidence", "0.7",
                       "--seeds", "0..7", "--filters", "ekf"},
                      kShortWay)},
      {"sensitivity", with({"sensitivity", field, "--vary", "oracle.range_sd_m=0.1..3", "--metric",
                            "filters.ekf.ate_rms_m", "--samples", "16", "--filters", "ekf"},
                           kShortWay)},
      {"render", with({"render", circle, "--seeds", "0..2"}, kSmall)},
      {"calibrate", {"calibrate", circle, "--seeds", "0..2"}}};
}

/// All files below a folder that are compared: what they are but for time and the way to them.
std::map<std::string, std::string> compared_files(const fs::path& folder) {
  const std::set<std::string> passed_over = {"timing.json", "invocation.json"};
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && !passed_over.contains(entry.path().filename()))
      files[fs::relative(entry.path(), folder)] = bytes_of(entry.path());
  return files;
}

class ShardedCommand : public testing::TestWithParam<Command> {
 protected:
  fs::path path(const std::string& name) const { return scratch_.path() / name; }
  Outcome run_shard(int number, int count, const Words& more = {}) const {
    const std::string shard = std::to_string(number) + "/" + std::to_string(count);
    const Words place = {"--shard", shard, "--out", path("s" + std::to_string(number)).string(),
                         "--jobs",  "1"};
    return run_stereobench(with(with(GetParam().words, place), more));
  }
  Outcome merge(const Words& shards, const std::string& out) const {
    Words words = {"merge"};
    for (const std::string& shard : shards) words.push_back(path(shard).string());
    return run_stereobench(with(words, {"--out", path(out).string()}));
  }

  TestFolder scratch_;
};

// Law: the same bytes, however many shards there are, in whatever order they come. Mutations: a shard that
// does all; one that leaves out its last unit; merged results without a word of the command.
TEST_P(ShardedCommand, MergesToTheBytesOfTheWhole) {
  const Outcome whole =
      run_stereobench(with(GetParam().words, {"--out", path("whole").string(), "--jobs", "1"}));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  unsigned long done = 0, all = 0;
  for (const int number : {3, 1, 2}) {
    const Outcome shard = run_shard(number, 3);
    ASSERT_EQ(shard.exit_code, 0) << shard.err;
    EXPECT_THAT(shard.out, HasSubstr("shard " + std::to_string(number) + " of 3 is done"));
    std::ifstream costs(path("s" + std::to_string(number)) / "costs.json");
    EXPECT_TRUE(costs.good());
    done += std::stoul(shard.out.substr(shard.out.find("is done, ") + 9));
    all = std::stoul(shard.out.substr(shard.out.find(" of ", shard.out.find("is done, ")) + 4));
  }
  EXPECT_EQ(done, all);
  const Outcome merged = merge({"s2", "s3", "s1"}, "merged");
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  const auto expected = compared_files(path("whole")), got = compared_files(path("merged"));
  for (const auto& [name, bytes] : expected) EXPECT_TRUE(got.contains(name) && got.at(name) == bytes) << name;
  EXPECT_EQ(got.size(), expected.size());
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShardedCommand, testing::ValuesIn(commands()),
                         [](const auto& test) { return test.param.name; });

class ShardedSweep : public ShardedCommand {};

// A shard that is run again does nothing twice; one that was killed goes on; merged shards that overlap are
// compared, and a changed bit is found.
TEST_P(ShardedSweep, IsCheckedByOverlapAndByHash) {
  for (const int number : {1, 2, 3}) ASSERT_EQ(run_shard(number, 3, {"--shard-overlap", "2"}).exit_code, 0);
  const std::string before = bytes_of(path("s1") / "unfinished.drives");
  EXPECT_THAT(run_shard(1, 3, {"--shard-overlap", "2"}).err, HasSubstr("6 of 6 drives were done before"));
  EXPECT_TRUE(bytes_of(path("s1") / "unfinished.drives") == before);
  EXPECT_EQ(merge({"s1", "s2", "s3"}, "merged").exit_code, 0);
  std::string changed = before;
  changed[before.size() / 2] = static_cast<char>(changed[before.size() / 2] ^ 1);
  std::ofstream(path("s1") / "unfinished.drives", std::ios::binary) << changed;
  const Outcome conflict = merge({"s1", "s2", "s3"}, "conflict");
  EXPECT_EQ(conflict.exit_code, 5);
  EXPECT_THAT(conflict.err, HasSubstr((path("s1") / "unfinished.drives").string()));
  EXPECT_FALSE(fs::exists(path("conflict") / "sweep.json"));
}

// What is asked for wrongly is one line with exit code 2, and nothing is written.
TEST_P(ShardedSweep, RefusesWhatDoesNotFit) {
  ASSERT_EQ(run_shard(1, 2).exit_code, 0);
  ASSERT_EQ(run_shard(2, 2).exit_code, 0);
  const auto refused = [&](const Outcome& outcome, const std::string& why) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  };
  refused(merge({"s1"}, "merged"), "1 of 2 shards are missing: 2");
  refused(merge({"s1", "s2"}, "s1"), "--out: expected a folder that is none of the shards");
  refused(run_shard(1, 3), "is of another shard");
  refused(run_shard(3, 2), "--shard: expected one of several shards");
  refused(run_shard(1, 2, {"--shard-costs", path("none").string()}), "none");
  EXPECT_FALSE(fs::exists(path("merged")));
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShardedSweep, testing::Values(commands()[1]),
                         [](const auto& test) { return test.param.name; });

// A suite, whose cases share pictures and may fail alone. Mutations: a fault that ends the shard; a merge
// that takes the drive of a failed case for missing.
TEST(ShardedSuite, MergesToTheBytesOfTheWhole) {
  const TestFolder scratch;
  const auto path = [&](const std::string& name) { return (scratch.path() / name).string(); };
  scratch.write("suite.yaml",
                "suite: trial\ncases:\n"
                "  - {name: good, scenario: '" +
                    scenario_path("open_field") +
                    "', seeds: 0..2, filters: [ekf],"
                    " set: ['path.points_m=[[-15, -18], [5, -18]]', path.closed=false, 'gates=[]']}\n"
                    "  - {name: bad, scenario: '" +
                    scenario_path("ball_circle") +
                    "', seeds: 0..1, filters: [ekf],"
                    " detector: 'exit 3', set: [path.laps=0.02, 'gates=[]']}\n");
  const Words test = {"test", path("suite.yaml")};
  EXPECT_EQ(run_stereobench(with(test, {"--out", path("out")})).exit_code, 4);
  fs::rename(path("out"), path("whole"));  // its pages name the folder
  for (const char* number : {"1", "2"}) {
    const Outcome shard = run_stereobench(
        with(test, {"--shard", number + std::string("/2"), "--out", path(std::string("s") + number)}));
    EXPECT_EQ(shard.exit_code, 0) << shard.err;
  }
  EXPECT_EQ(run_stereobench({"merge", path("s2"), path("s1"), "--out", path("out")}).exit_code, 4);
  const auto expected = compared_files(path("whole")), got = compared_files(path("out"));
  for (const auto& [name, bytes] : expected) EXPECT_TRUE(got.contains(name) && got.at(name) == bytes) << name;
  EXPECT_EQ(got.size(), expected.size());
}

// Costly cells are spread by what they cost, and what was measured is not done again. Mutations: units cut by
// count; measured units done again; the merge without shard 0.
TEST(ShardCosts, CutTheWorkEvenly) {
  const TestFolder scratch;
  const Words sweep = with({"sweep", scenario_path("open_field"), "--vary", "particles=1,300", "--seeds",
                            "0..4", "--filters", "fastslam2", "--set", "gates=[]"},
                           kShortWay);
  const auto drives_of_shard = [&](const std::string& number, const Words& more) {
    const Words place = {"--shard", number + "/5", "--out", (scratch.path() / ("s" + number)).string()};
    const Outcome outcome = run_stereobench(with(with(sweep, place), more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return std::stoi(outcome.out.substr(outcome.out.find("is done, ") + 9));
  };
  EXPECT_EQ(drives_of_shard("0", {}), 2) << "one of each kind";
  const fs::path costs_file = scratch.path() / "costs.json";
  const Words costs = {"--shard-costs", costs_file.string()};
  nlohmann::json measured = nlohmann::json::parse(bytes_of(scratch.path() / "s0" / "costs.json"));
  double seconds = 1.0;
  for (auto& kind : measured["kinds"]) kind["seconds"] = std::exchange(seconds, 100.0);
  std::ofstream(costs_file) << measured;
  std::vector<int> drives;
  for (const char* number : {"1", "2", "3", "4", "5"}) drives.push_back(drives_of_shard(number, costs));
  std::ranges::sort(drives);
  EXPECT_THAT(drives, testing::ElementsAre(1, 1, 1, 1, 4)) << "each costly drive has a shard of its own";
  Words merge = {"merge", "--out", (scratch.path() / "merged").string()};
  for (const char* number : {"1", "2", "3", "4", "5"})
    merge.push_back((scratch.path() / (std::string("s") + number)).string());
  EXPECT_THAT(run_stereobench(merge).err, HasSubstr("1 of 5 shards are missing: 0"));
  merge.push_back((scratch.path() / "s0").string());
  const Outcome merged = run_stereobench(merge);
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_THAT(merged.err, HasSubstr("10 of 10 drives were done before"));
}

}  // namespace
}  // namespace stereobench::harness
